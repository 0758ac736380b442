"""Live runs: people watch them and interfere."""
