"""Links that carry frames to a robot and back."""
