"""The library that flies compiled apps: real time, journal, gateway, drones, station and trials."""

__version__ = "0.1.0"
"""Its second number is the seam that it speaks, until the first one is more than 0."""
