"""A fault campaign: each fault in each configuration, the outcomes, and a report."""
