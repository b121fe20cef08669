"""The files that are made from the table of addresses and the types of the wire."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import pluto_fleet
from pluto_fleet.station.web.reads import DESCRIPTION
from pluto_fleet.station.web.static import FOLDER

from .openapi import description
from .python_client import calls
from .typescript import declarations


def made() -> Mapping[Path, str]:
    """Return the text of each of them."""
    found = description()
    return {
        DESCRIPTION: json.dumps(found, indent=1) + "\n",
        FOLDER / "wire.d.ts": declarations(found),
        Path(pluto_fleet.__file__).parent / "client" / "calls.py": calls(),
    }
