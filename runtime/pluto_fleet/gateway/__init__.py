"""The gateway: between the app's brain and its drones, so that the brain may come and go."""
