"""Stations of examples, as in the tests of flights."""

from tests.library.station.flights.conftest import programs, serve

__all__ = ["programs", "serve"]
