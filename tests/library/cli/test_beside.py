"""The fleet file beside the missions is flown where no other one is named, and that is said."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.cli.options import parse
from pluto_fleet.cli.plans import take_fleet_beside
from tests.library.files.an_app import APP


@pytest.mark.parametrize(
    ("words", "is_taken"),
    [
        (["simulate", "M", "--runs", "2"], True),
        (["size", "M"], True),
        (["check", "M"], True),
        (["fly", "M", "--sim"], True),
        (["fly", "M", "--crtp-sim", "2"], True),
        (["fly", "M", "--sim", "--dry-run"], True),
        (["serve", "--sim", "--missions", "M"], True),
        (["fly", "M"], False),
        (["fly", "M", "--dry-run"], False),
        (["serve", "--missions", "M"], False),
        (["serve", "--sim"], False),
        (["drones"], False),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_real_drones_fly_only_by_a_fleet_that_is_named(
    missions: Path, words: list[str], is_taken: bool
) -> None:
    """A file that just lies there moves nothing."""
    beside = missions.with_name("fleet.toml")
    beside.touch()
    options = parse(APP, [str(missions) if word == "M" else word for word in words])
    take_fleet_beside(options)
    assert options.fleet == (beside if is_taken else None)
