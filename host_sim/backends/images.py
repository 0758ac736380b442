"""The boards that flash images are built for."""

BOARDS = ("feather_stm32f405", "blue_pill")
"""Boards that can be emulated."""
