"""Exports recorded logs to file formats of other programs."""
