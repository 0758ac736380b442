"""How frames get to a robot and back."""
