"""The flights of the past: what pages showed of them, to be replayed, reported and exported."""
