"""A page for each code: what the diagnostic means, and an example that gives it, and its mending."""
