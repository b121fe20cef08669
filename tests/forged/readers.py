"""Everything that reads journals: what it raises beside a sentence for people is a fault."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from traceback import format_exc
from typing import Any

from pluto_fleet.cli import main
from pluto_fleet.cli.calibrate import main as calibrate
from pluto_fleet.flight.lives import reopen
from pluto_fleet.flight.mission_status import records_in
from pluto_fleet.report.report import report_of, waiting_lines
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.between_flights import FleetHistory
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.results.flights import ResultsOfFlights
from pluto_fleet.station.results.tables import cells, csv_text, geojson
from tests.library.station.history.test_past import FARM, past_of
from tests.library.station.plan.drawing import FLEET

FLIGHT = "forged"


def readers(folder: Path) -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield what can be asked of the flight in a folder."""
    journal = folder / f"{FLIGHT}.journal"
    past = past_of(folder)
    yield "journal", lambda: _run(lambda: main(FARM, ["journal", str(journal)]))
    yield "journal --json", lambda: _run(lambda: main(FARM, ["journal", str(journal), "--json"]))
    yield "calibrate", lambda: calibrate([str(journal)])
    yield "report of a flight", lambda: _report(journal)
    yield "resume", lambda: reopen(FARM, journal).store.close()
    config = StationConfig(folder=folder, fleet=FLEET, faults={}, sim=True)
    yield "station", lambda: FleetHistory(FARM, config).read()
    yield "flights", lambda: json.dumps([past.flights(), past.hours()], allow_nan=False)
    yield "replay", lambda: _replay(past)
    yield "report", lambda: json.dumps(past.report(FLIGHT), allow_nan=False)
    yield "mcap", lambda: past.mcap(FLIGHT)
    yield "console", lambda: past.console(FLIGHT).encode()
    yield "results", lambda: _results(folder)


def faults_of(folder: Path, *, only: Sequence[str] = ()) -> Iterator[str]:
    """Yield what readers do with a flight that they must not."""
    said = io.StringIO()
    for name, read in readers(folder):
        if only and name not in only:
            continue
        try:
            with redirect_stdout(said), redirect_stderr(said):
                read()
        except BadInput as error:
            if len(str(error)) > 2_000:
                yield f"{name}: it says {len(str(error))} characters"
        except Exception:  # noqa: BLE001 - whatever it is, it is a fault
            yield f"{name}: {format_exc()}"


def _run(command: Callable[[], int]) -> None:
    code = command()
    assert code in (0, 1, 2), f"it ends with {code}"


def _report(journal: Path) -> None:
    records = records_in(FARM, journal)
    report_of(FARM, journal, records)
    list(waiting_lines(FARM, journal, records))


def _replay(past: Any) -> None:
    start: float | None = 0.0
    parts = 0
    while start is not None and parts < 30:
        part = past.replay(FLIGHT, start)
        json.dumps(part, allow_nan=False)
        assert part["next"] is None or part["next"] > start
        start = part["next"]
        parts = parts + 1


def _results(folder: Path) -> None:
    found = ResultsOfFlights(FARM, folder).of(FLIGHT)
    csv_text(cells(found)).encode()
    json.dumps(geojson(found, "farm"), allow_nan=False)
