"""What is on a bus, live: every robot decoded, and what looks wrong."""
