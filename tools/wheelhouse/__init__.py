"""Implementation of tools/wheels."""
