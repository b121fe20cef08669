"""The files that are made from the declared interface and the types of the wire."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from pluto_fleet.station.web.handlers import DESCRIPTION
from pluto_fleet.station.web.static import FOLDER

from .openapi import description
from .typescript import declarations


def made() -> Mapping[Path, str]:
    """Return the text of each of them."""
    found = description()
    return {
        DESCRIPTION: json.dumps(found, indent=1) + "\n",
        FOLDER / "wire.d.ts": declarations(found),
    }
