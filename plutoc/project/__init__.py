"""An app on the disk: its source, the package made of it, and the developer's own code."""
