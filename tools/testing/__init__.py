"""What tools/test is made of."""
