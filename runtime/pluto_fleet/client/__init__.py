"""A client of a ground station, for scripts and other programs.

`docs/http.md` has an example.
"""

from .connection import Outdated, Refused
from .station import Station

__all__ = ["Outdated", "Refused", "Station"]
