"""A mission's way through the graph of its app, from its start to its end."""
