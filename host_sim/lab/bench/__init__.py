"""`tools/bench`: measures speed, and compares runs of all firmware images."""
