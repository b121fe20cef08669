"""The drones: who is free, who can fly what, who gets one, and how they are commanded."""
