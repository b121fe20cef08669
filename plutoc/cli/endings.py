"""How the program ends: its exit codes, and what is wrong with how it was called."""

from __future__ import annotations

CLEAN, ERRORS, USAGE, REFUSED, INTERNAL, INTERRUPTED, CLOSED_PIPE = 0, 1, 2, 3, 70, 130, 141


class Unusable(Exception):
    """Wrong usage, or a file that cannot be read or written. The text says so to a person."""
