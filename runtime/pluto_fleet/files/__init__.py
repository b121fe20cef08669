"""The two files that a user writes: missions and fleet (docs/files.md)."""
