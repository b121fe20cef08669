"""Mishaps that are rehearsed in simulation: what is lost, and what only a person can know."""

from __future__ import annotations

import pytest

from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.trials.invariants import violations
from tests.kit import apps
from tests.kit.living import Living, enterable, names


def item_mission() -> apps.Mission:
    return apps.mission("a", apps.pick("p", 3), apps.release("r", 9))


def two_drones() -> FleetFile:
    return apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))


def patient(living: Living) -> Living:
    """Let a life go on while its missions wait for a person, as a station's do."""
    living.life.patient = True
    return living


def happens(living: Living, drone: str, kind: str) -> list[str]:
    """Let the gateway have a mishap happen; the list has its answer once there is one."""
    answers: list[str] = []
    asked = living.life.control.mishaps.happen(drone, kind)
    living.kernel.spawn(asked, FLEET, "a mishap").watch(lambda task: answers.append(task.result()))
    return answers


@pytest.mark.parametrize("answer", ["done", "not-done"])
def test_no_report_comes_of_an_action_and_a_person_is_asked(answer: str) -> None:
    living = patient(Living(enterable(), item_mission()))
    living.at(2.0, lambda: living.life.control.mishap("cf1", "uncertain"))
    living.at(60.0, lambda: living.life.control.decide("a", answer))
    living.run(59.0)
    (asked,) = living.named("mission.uncertain")
    assert asked["reason"] == "was pick_item of trip p done by cf1? It could not be seen"
    assert living.done_by_drones == [("pick_item", "pills")]
    assert living.named("trip.completed") == []
    living.run()
    assert living.statuses == ["COMPLETED"]
    assert len(living.done_by_drones) == (2 if answer == "done" else 3)  # it had been done
    assert violations(living.events, {}) == []


def test_what_is_safe_to_do_once_more_is_asked_about_by_no_one() -> None:
    living = Living(enterable(), apps.mission("a", apps.trip("1", 3)), on=two_drones())
    living.run(2.0)
    (flown,) = living.named("trip.launched")
    with pytest.raises(BadInput, match="take_photo, which is safe to do once more: nothing would"):
        living.life.control.mishap(str(flown["drone"]), "uncertain")
    with pytest.raises(BadInput, match="cf1 flies for no mission"):
        living.life.control.mishap("cf1", "uncertain")
    with pytest.raises(BadInput, match='no drone "cf7" is in the fleet'):
        living.life.control.mishap("cf7", "crash")


@pytest.mark.parametrize(
    ("kind", "reason", "comes_back"),
    [
        ("crash", "cf2 crashed at", False),
        ("lost", "cf2 lost its link at", True),
        ("battery", "cf2 ran out of battery at", True),
    ],
)
def test_a_drone_fails_in_flight(kind: str, reason: str, comes_back: bool) -> None:
    living = Living(enterable(attempts=3), apps.mission("a", apps.trip("1", 3)), on=two_drones())
    living.at(2.0, lambda: happens(living, "cf2", kind))
    assert living.run() == ["COMPLETED"]
    (failed,) = living.named("trip.failed")
    assert str(failed["reason"]).startswith(reason)
    assert ("cf2" not in names(living.named("drone.lost"), "drone")) is comes_back
    assert violations(living.events, {}) == []


def test_a_drone_on_the_ground_and_one_that_is_down_have_no_mishap() -> None:
    living = Living(enterable(attempts=3), apps.mission("a", apps.trip("1", 9)), on=two_drones())
    stands = happens(living, "cf1", "crash")
    living.run(2.0)
    happens(living, "cf2", "lost")
    living.run(2.1)
    again = happens(living, "cf2", "crash")
    living.run(2.2)
    assert stands == ["cf1 stands on the ground: mishaps happen in the air"]
    assert again[0].startswith("cf2 is down already: cf2 lost its link")
