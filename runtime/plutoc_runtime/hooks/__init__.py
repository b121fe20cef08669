"""Calling the app's hooks, and what they are given."""
