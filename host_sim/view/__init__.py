"""The state of a run, as every display shows it."""
