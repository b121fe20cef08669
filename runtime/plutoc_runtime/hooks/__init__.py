"""Calls to the code that the app's developer wrote, and what it is given."""
