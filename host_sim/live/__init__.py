"""A run that people watch, and meddle with."""
