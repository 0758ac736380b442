"""What tools/wheels builds wheels with."""
