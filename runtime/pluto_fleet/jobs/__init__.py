"""What passes between an app and what flies its drones, as plain data."""
