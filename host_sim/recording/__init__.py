"""A run that has been: its log, its world, and what is worked out from them."""
