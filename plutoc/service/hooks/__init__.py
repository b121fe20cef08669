"""What hooks.py can ask of missions, trips, drones and the rest, while it is being typed."""
