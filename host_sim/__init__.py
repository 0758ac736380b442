"""The simulator of the robot's world: the arena, the robot's senses, and the link to the firmware."""
