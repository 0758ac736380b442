"""Implementation of tools/coverage."""
