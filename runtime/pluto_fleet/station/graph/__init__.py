"""The app's own graph, and how it is laid out: boxes in rows that turn like a road."""
