"""What tools/coverage is made of."""
