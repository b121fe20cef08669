"""What is said of a flight: what happened, what came of it, and how far it is."""
