"""Keeps drones in the air apart, in space and not in time: what one has taken, no other enters."""
