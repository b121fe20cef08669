"""The header row of a journal: its app and its plan."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import __version__
from ..files.fleet import FleetFile
from ..files.stand_ins import fleet_from, stand_ins_in
from ..shared.alone.world import FAULTS
from . import errors

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.actions import Action

Header = Mapping[str, Any]


def header(
    app: App,
    *,
    missions: str,
    fleet: str | None,
    sim: bool,
    stand_ins: Mapping[str, object] | None = None,
    seed: int,
    faults: Mapping[str, float] | None = None,
    inherited: Mapping[str, object] | None = None,
    by: str = "",
) -> dict[str, object]:
    """Return the header of a new journal, with the texts of the two files for later runs.

    `stand_ins` says which drones are simulated down to their protocol, and how many: `{"crtp_sim": 3}`.
    `inherited` has the drones that are lost, repaired or retired since earlier flights, or have joined; `by` is the
    name of the person who started it, if that is known.
    """
    return {
        "t": 0.0,
        "event": "journal.begun",
        "app": app.name,
        "app_hash": fingerprint(app),
        "takes": {one.name: _takes(one) for one in app.actions.values() if one.hook is not None},
        "seam": app.seam,
        "library": __version__,
        "missions": missions,
        "fleet": fleet,
        "sim": sim,
        **({"crtp_sim": None} if stand_ins is None else stand_ins),
        "seed": seed,
        "faults": dict(faults or {}),
        **({"by": by} if by else {}),
        **(inherited or {}),
    }


def _takes(action: Action) -> dict[str, object]:
    """Return with how many seconds plans reckon, and the parameter of a trip that may say otherwise."""
    reckoned: dict[str, object] = {"seconds": action.lasts({})}
    return {**reckoned, "parameter": action.takes} if isinstance(action.takes, str) else reckoned


def check(path: Path, header: Header, app: App) -> None:
    """Raise a `JournalError` if this app cannot resume a journal with this header."""
    if header.get("app") != app.name:
        raise errors.of_another_app(path, str(header.get("app")), app.name)


def check_whole(path: Path, header: Header, app: App) -> None:
    """Raise a `JournalError` also if it does not say all that is needed to go on."""
    check(path, header, app)
    if lacking := sorted(_NEEDED - header.keys()):
        raise errors.header_lacks(path, ", ".join(lacking))
    if not header["faults"].keys() <= set(FAULTS) or not all(
        0 < (header.get(key) or 1) <= MOST_DRONES for key in ("crtp_sim", "mavlink_sim")
    ):
        raise errors.strange(path, "its first row says how drones are simulated as nobody can")


_NEEDED = {"missions", "fleet", "sim", "seed", "faults", "app_hash"}

MOST_DRONES = 1_000
"""The most simulated drones that a header may ask for."""


def fleet_in(app: App, journal: Path, header: Header) -> FleetFile:
    """Return the fleet of a journal; raise `BadInput` if it does not fit the app any more."""
    return fleet_from(app, f"{journal} (its fleet)", header["fleet"], stand_ins_in(header))


def fingerprint(app: App) -> str:
    """Return a checksum of the app's graph and of the fields of its missions."""
    sums = hashlib.sha256()
    for module in (app.flow.__module__, app.mission.__module__):
        file = getattr(sys.modules.get(module), "__file__", None)
        if file is not None and Path(file).is_file():
            sums.update(Path(file).read_bytes())
    return sums.hexdigest()
