"""What any display shows of a run."""
