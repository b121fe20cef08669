"""A simulated team of drones in a simulated world: what `simulate` and `fly --sim` fly."""
