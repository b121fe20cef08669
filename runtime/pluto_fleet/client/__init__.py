"""A client of a ground station, for scripts and other programs.

`docs/http.md` has an example.
"""

from .station import Outdated, Refused, Station

__all__ = ["Outdated", "Refused", "Station"]
