"""pytest-canbench: tests of a device on a CAN bus, with injected faults. docs/bench.md explains it."""
