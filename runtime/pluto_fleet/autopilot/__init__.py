"""Simulated vehicles that speak MAVLink as PX4 and ArduPilot do: N of them behind one UDP port."""
