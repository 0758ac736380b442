"""The world: environments, arena, and the bodies and sensors of the robots in it."""
