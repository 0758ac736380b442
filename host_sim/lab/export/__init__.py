"""Recorded logs as files that other programs read."""
