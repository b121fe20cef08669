"""Simulation without the library: each drone alone in the air, in virtual time."""
