"""Processes of the library: real time, signals, forks, and lines of JSON between them."""
