"""Vehicles that speak MAVLink, such as PX4's and ArduPilot's, flown by way of MAVSDK."""
