"""The images that are flashed, and the boards that they are for."""

BOARDS = ("feather_stm32f405", "blue_pill")
"""Boards that can be emulated."""
