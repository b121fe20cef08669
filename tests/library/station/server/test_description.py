"""The description of the interface is that of this source, and sound."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from openapi_spec_validator import validate

from pluto_fleet.station.web.reads import DESCRIPTION
from station_interface.made import made
from tests.library.station.server.asking import asked


@pytest.mark.parametrize(("file", "text"), made().items(), ids=[file.name for file in made()])
def test_what_is_made_from_the_types_of_the_wire_is_current(file: Path, text: str) -> None:
    """`python -m station_interface` makes it anew."""
    assert file.read_text(encoding="utf-8") == text


def test_the_description_is_valid_openapi_and_is_served() -> None:
    validate(json.loads(DESCRIPTION.read_text(encoding="utf-8")))
    assert asked()("GET", "/api/openapi.json").body == DESCRIPTION.read_bytes()
