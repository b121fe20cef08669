"""Crazyflies, flown through cflib: an optional package, imported when a radio is opened."""
