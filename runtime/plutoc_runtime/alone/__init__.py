"""What needs no library: simulation, each drone alone in the air, and a kit for tests of hooks."""
