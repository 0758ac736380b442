"""The world: environments, arena, sensors, and one robot's way through them."""
