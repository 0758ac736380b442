"""The images that are flashed, and the boards that they are for."""

BOARDS = ("stm32f405", "stm32f103")
"""Boards that can be emulated."""
