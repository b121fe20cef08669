"""Changing an app: an operation, and the smallest edits of the text that do it."""
