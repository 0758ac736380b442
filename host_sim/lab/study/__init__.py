"""Comparing behaviours: the same worlds for each, in process, on all cores."""
