"""What tools/misra is made of."""
