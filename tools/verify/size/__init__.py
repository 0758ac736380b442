"""How big the images are, and of what."""
