"""pytest-canbench: tests of a device on a CAN bus, with faults made on purpose. docs/bench.md tells how."""
