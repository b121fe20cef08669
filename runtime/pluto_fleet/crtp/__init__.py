"""Simulated Crazyflies, which speak the protocol of real ones: for flights without hardware."""
