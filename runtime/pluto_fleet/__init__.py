"""What flies a compiled app: real time, journal, gateway, drones, station and trials."""
