"""How the drones of a fleet really move, found from the journals of their flights (docs/calibration.md)."""
