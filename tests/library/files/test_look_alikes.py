"""Names that look alike are told: a reader would take one for the other."""

from __future__ import annotations

import pytest

from pluto_fleet.files.drones import DroneEntry
from pluto_fleet.files.plan_check import look_alikes
from tests.kit import apps


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("caf\u00e9", "cafe\u0301"),
        ("North", "north"),
        ("\u0430pple", "apple"),
        ("\uff21", "A"),
        ("a b", "a  b"),
        ("stra\u00dfe", "STRASSE"),
        ("\u03bdan", "van"),
        ("kit", "\u043ait"),
        ("A-1", "A\u20111"),
        ("North", "North\ufe0f"),
        ("North", "No\u034frth"),
        ("North", "North\u3164"),
    ],
)
def test_two_names_that_look_alike_are_told(one: str, other: str) -> None:
    """And by which characters they differ; of missions, and of trips of one mission."""
    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in (one, "between", other)]
    (said,) = look_alikes(missions)
    assert f"({one!a} and {other!a}): rename one" in said
    trips = apps.mission("m", apps.trip(one, 3.0), apps.trip(other, 4.0))
    (said,) = look_alikes([trips])
    assert 'two trips of mission "m" are easily taken' in said
    drones = [DroneEntry(id=id, category="scout", home=(0.5, 0.5, 0.0)) for id in (one, other)]
    (said,) = look_alikes([], drones)
    assert "two drones are easily taken" in said


def test_names_that_differ_are_left_alone() -> None:
    """Also the same one twice, which is refused where it must be."""
    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in ("a1", "al", "b", "\u00e9")]
    assert not list(look_alikes([*missions, missions[0]]))
