"""Fault injection on the bus: a schedule as data, and a link that follows it."""
