"""From text to tree: what was written, and where; nothing is looked up here."""
