"""The gateway between the app's brain and its drones, which outlives the brain."""
