"""A campaign of faults: each fault in each configuration, what came of it, and a report that people read."""
