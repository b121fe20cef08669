"""The ground station, which serves an app in a browser."""
