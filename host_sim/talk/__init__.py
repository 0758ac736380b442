"""ELIZA of 1966, and a robot that answers from its log."""
