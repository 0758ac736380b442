"""Bus faults on purpose: a schedule as data, and a link that follows it."""
