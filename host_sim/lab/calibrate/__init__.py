"""Robots of their own that measure themselves."""
