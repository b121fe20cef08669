"""Stations of examples, as in the tests of flights."""

from tests.library.station.flights.conftest import serve

__all__ = ["serve"]
