"""The boards with flash images."""

BOARDS = ("feather_stm32f405", "blue_pill")
"""Boards that can be emulated."""
