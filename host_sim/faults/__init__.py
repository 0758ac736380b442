"""Faults of a bus, made on purpose: a schedule as data, and a link that keeps to it."""
