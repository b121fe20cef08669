"""Checking the developer's hooks against what the app declares."""
