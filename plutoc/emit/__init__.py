"""From a plan to the files of a generated package: pure functions that return text."""
