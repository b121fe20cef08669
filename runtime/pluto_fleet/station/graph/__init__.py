"""The app's own graph, and how it is laid out: layer by layer from top to bottom."""
