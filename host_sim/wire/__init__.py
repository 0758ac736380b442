"""The wire: frames, the conversation with a robot, and the record of it."""
