"""The library that flies compiled apps: real time, journal, gateway, drones, station and trials."""

__version__ = "3.3.0"
"""Its first two numbers are the newest seam that it speaks."""
