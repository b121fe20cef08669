"""Stations, as the tests of flights start them."""

from tests.library.station.flights.conftest import programs, serve

__all__ = ["programs", "serve"]
