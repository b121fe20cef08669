"""A call that keeps Python's own lock until it is let go, as one does that reads a very long text."""

from __future__ import annotations

from ctypes import PyDLL, create_string_buffer


def held(_: object, reads: int) -> bytes:
    """Wait for a byte from a pipe, and let no other thread of this process do anything meanwhile."""
    byte = create_string_buffer(1)
    PyDLL(None).read(reads, byte, 1)
    return byte.raw
