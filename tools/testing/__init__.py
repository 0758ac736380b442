"""Implementation of tools/test and tools/prove."""
