"""Reports of a flight: its events, its outcome, its progress."""
