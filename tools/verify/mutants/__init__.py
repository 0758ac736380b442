"""Implementation of tools/mutate."""
