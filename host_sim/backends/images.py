"""The boards with flash images."""

BOARDS = ("feather_stm32f405", "blue_pill", "nucleo_g431rb")
"""Boards that can be emulated."""
