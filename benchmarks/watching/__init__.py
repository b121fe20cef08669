"""What `station.py` is made of: a large flight, its server, and who watches it."""
