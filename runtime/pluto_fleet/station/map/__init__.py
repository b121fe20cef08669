"""The map: its names, its floor plan, and the file that keeps them."""
