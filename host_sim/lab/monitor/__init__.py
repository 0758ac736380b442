"""Monitors a bus live: decodes every robot's frames, and reports problems."""
