"""Live runs, which people watch and interact with."""
