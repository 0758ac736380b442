"""The conversation with a robot."""
