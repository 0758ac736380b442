"""Compares behaviours in the same worlds, in process, on all cores."""
