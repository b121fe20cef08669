"""What people have acknowledged is known to all of them, and to the next station."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.attention.attention import KEPT
from pluto_fleet.station.attention.causes import Cause, of_drones, of_missions
from pluto_fleet.station.wire import Alert

from .lists import Listed, drone, mission


def lost() -> list[Cause]:
    return list(of_drones([drone("cf1", "LOST")], ()))


def test_an_acknowledgement_outlives_the_station_and_the_flight(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [alert] = listed.look(lost())
    assert listed.attention.acknowledge(alert["id"], "Ana") == "acknowledged by Ana"
    assert listed.attention.acknowledge(alert["id"], "Ben") == "acknowledged already by Ana"
    listed.again()
    [after] = listed.look(lost(), flight="another")
    assert after == {**alert, "by": "Ana", "by_at": 1000}


def test_what_arises_again_is_another_alert(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [first] = listed.look(lost())
    listed.attention.acknowledge(first["id"], "")
    assert listed.look([]) == []
    listed.again()
    [second] = listed.look(lost())
    assert second["id"] != first["id"] and second["by"] is None
    assert {one["id"] for one in listed.attention.rows} == {first["id"], second["id"]}


def test_pages_are_told_what_has_changed_and_no_more(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    [alert] = listed.look(lost())
    before = listed.version
    listed.look(lost())
    assert not list(listed.attention.rows.since(before))
    listed.look(of_drones([drone("cf1", "LOST", "it fell")], ()))
    assert len(list(listed.attention.rows.since(before))) == 1
    before = listed.version
    listed.attention.acknowledge(alert["id"], "Ana")
    listed.look(of_drones([drone("cf1", "LOST", "it fell")], ()))
    assert len(list(listed.attention.rows.since(before))) == 1


def test_of_what_is_over_the_newest_are_kept(tmp_path: Path) -> None:
    listed = Listed(tmp_path / "attention.json")
    for n in range(KEPT + 20):
        listed.look(of_missions([mission(f"{n}", "FAILED")]))
    kept: list[Alert] = list(listed.attention.rows)
    assert len(kept) == KEPT and kept[-1]["mission"] == f"{KEPT + 19}"


def test_what_is_no_alert_any_more_cannot_be_acknowledged(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r'there is no alert "x\\n" any more'):
        Listed(tmp_path / "attention.json").attention.acknowledge("x\n", "Ana")


@pytest.mark.parametrize("text", ["", "{}", "[1]", '[{"id": 1}]', "[]\x00"])
def test_a_file_that_cannot_be_read_keeps_no_one_from_flying(tmp_path: Path, text: str) -> None:
    (tmp_path / "attention.json").write_text(text)
    assert len(Listed(tmp_path / "attention.json").look(lost())) == 1
