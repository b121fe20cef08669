"""The runtime that a generated package carries: the standard library and itself."""
