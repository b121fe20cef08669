"""The code that a developer added, held against what the app declares."""
