"""Implementation of tools/misra."""
