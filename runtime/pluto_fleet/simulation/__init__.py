"""A simulated team of drones in a simulated world, for `simulate` and `fly --sim`."""
