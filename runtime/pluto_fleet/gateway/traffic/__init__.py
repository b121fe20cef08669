"""Keeping drones in the air apart, in space and not in time: no drone enters space reserved by another."""
