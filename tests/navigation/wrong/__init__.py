"""Navigations that are wrong on purpose, a file each; `FOUND_BY` is the check that must find it."""
