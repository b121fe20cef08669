"""What the station says by keys, and the catalogue of the pages that says it in each language."""

from __future__ import annotations

import re
from pathlib import Path
from typing import get_args

import pluto_fleet.station
from pluto_fleet.station.wire import SaidKey

STATION = Path(pluto_fleet.station.__file__).parent
CATALOGUE = (STATION / "pages" / "texts" / "en.js").read_text("utf-8")


def test_the_catalogue_says_all_that_the_station_can_say() -> None:
    """Neither is a key without a text, nor a text without a key."""
    said = re.findall(r'^  "said\.([a-z.-]+)":', CATALOGUE, re.MULTILINE)
    assert sorted(said) == sorted(get_args(SaidKey))


def test_every_key_is_sent_from_somewhere_and_only_by_that_one_function() -> None:
    """The keys that stand in the sources of the station are those of the wire."""
    sources = {
        path: path.read_text("utf-8") for path in STATION.rglob("*.py") if path.name != "wire.py"
    }
    sent = {key for text in sources.values() for key in re.findall(KEY, text)}
    assert sent == set(get_args(SaidKey))
    assert [path.name for path, text in sources.items() if re.search(r'\{"key": key', text)] == [
        "words.py"
    ]


KEY = r'"((?:alert|preflight|question|wait)\.[a-z-]+)"'
