"""What the app and its user speak of: missions, trips, drones, the map; numbers, fields and words."""
