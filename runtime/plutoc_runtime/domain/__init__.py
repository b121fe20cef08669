"""The domain model: missions, trips, drones, the map; numbers with units, fields and text."""
