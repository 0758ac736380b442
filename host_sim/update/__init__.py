"""Firmware updates over CAN, as docs/update.md has them."""
