"""What is left of a run: pages, pictures, numbers, and what they are made from."""
