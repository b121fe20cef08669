"""What an editor asks about an app while it is written: pure functions of a text, and of its hooks."""
