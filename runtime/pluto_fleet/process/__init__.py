"""Processes: real time, signals, forks, locks, and lines of JSON between processes."""
