"""The drones: their statuses, what each can fly, their allocation, and how they are commanded."""
