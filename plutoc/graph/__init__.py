"""From tree to graph: every name looked up, every unit checked, every edge's statuses known."""
