"""Crazyflies, flown through cflib, an optional package that is imported when a radio is opened."""
