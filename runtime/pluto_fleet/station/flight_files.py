"""All that is read of the files of flights, which anybody may have written.

It is read in a process of its own (`process/apart.py`), which answers functions of it: what a file costs,
costs neither the drones that fly nor the pages. And SQLite keeps the locks of the journal that the station writes:
a process loses them where it opens and closes that file in any other way.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from ..shared.domain.errors import BadInput
from .history.past import PastFlights
from .map.drawn import MapFile, name_of
from .results.flights import ResultsOfFlights

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..app import App
    from .config import StationConfig


class FlightFiles:
    """The flights of a station's folder."""

    def __init__(self, app: App, config: StationConfig) -> None:
        self._map = MapFile(config.map_path)
        self._past = PastFlights(app, config, self._name_of)
        self._results = ResultsOfFlights(app, config.folder, self._name_of)

    @property
    def past(self) -> PastFlights:
        """The flights of the past, on the map as it is drawn now."""
        self._look_at_the_map()
        return self._past

    @property
    def results(self) -> ResultsOfFlights:
        """The results of all flights, on the map as it is drawn now."""
        self._look_at_the_map()
        return self._results

    def _look_at_the_map(self) -> None:
        with suppress(BadInput):  # then places have the names that they had
            self._map.read()

    def _name_of(self, point: Sequence[float]) -> str | None:
        return name_of(self._map.landmarks, point)
