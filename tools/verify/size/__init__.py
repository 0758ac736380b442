"""Sizes of the flash images and of their parts."""
