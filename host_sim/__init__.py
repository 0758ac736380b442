"""The world that the robot lives in: its arena, its senses, and the wire to the firmware."""
