"""The ground station: it serves an app in a browser."""
