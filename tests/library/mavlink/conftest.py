"""Flights through MAVSDK are tried where it is installed, with the extra `test`."""

from __future__ import annotations

from importlib.util import find_spec

collect_ignore_glob = [] if find_spec("mavsdk") and find_spec("pymavlink") else ["test_*.py"]
