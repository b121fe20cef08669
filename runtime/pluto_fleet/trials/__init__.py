"""Trials of an app with all kinds of faults, and the invariants that every run must satisfy."""
