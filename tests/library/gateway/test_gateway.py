"""The gateway between a brain that may come and go, and its drones."""

from __future__ import annotations

import pytest

from pluto_fleet.gateway.gateway import Busy
from pluto_fleet.jobs.reports import Down, FleetReport, JobState
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.errors import BadInput, Failure, FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.flights import PILLS, THERE, Field, Task
from tests.library.simulation.flights import fly


def called(field: Field) -> FleetReport:
    return fly(field.kernel, field.link(99).fleet_report())


def states(fleet_report: FleetReport) -> dict[str, JobState]:
    return {id: entry.state for id, entry in fleet_report.jobs.items()}


def test_what_was_done_is_not_done_again_but_reported_again() -> None:
    """A brain that gives the same job hears what came of it then; never from within the call."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    link.fly(Task(action="measure", item=None), heard.append)
    field.advance(100)
    link = field.link(2)
    link.fly(Task(action="measure", item=None, drone="cf2"), heard.append)
    assert len(heard) == 1
    field.advance(0)
    assert heard[0] == heard[1]
    assert (field.deeds, field.navigation.flown("cf2")) == ([Task().id], 0)


def test_a_job_under_way_outlives_the_brain_that_gave_it() -> None:
    """The brain that comes after it attaches, and hears the end; the old one hears nothing."""
    field, old, new = Field(), list[object](), list[object]()
    field.link(1).fly(Task(), old.append)
    field.advance(10)
    link = field.link(2)
    fleet_report = fly(field.kernel, link.fleet_report())
    assert states(fleet_report) == {Task().id: JobState.FLYING}
    assert not fleet_report.drones["cf1"].landed
    link.attach(Task().id, new.append)
    field.advance(100)
    assert (old, new) == ([], [None])


def test_an_end_that_was_not_heard_is_told_to_the_next_who_attaches() -> None:
    """Failures too, with their reason."""
    field, heard = Field(faults=Faults(action=1)), list[object]()
    field.link(1).fly(Task(), lambda _: None)
    field.advance(1)
    link = field.link(2)
    field.advance(100)
    link.attach(Task().id, heard.append)
    link.attach("unknown", heard.append)
    field.advance(0)
    (error,) = heard
    assert isinstance(error, FlightFailed)
    assert (error.failure, str(error)) == (
        Failure.ACTION,
        "pick_item failed: cf1 could not do it at (4, 5)",
    )


def test_an_older_brain_commands_nothing() -> None:
    """It is told so, once; and what it gives in between is not flown."""
    field, lost = Field(), list[str]()
    old = field.link(1, lambda: lost.append("old"))
    new = field.link(2, lambda: lost.append("new"))
    assert lost == []
    old.fly(Task(), lambda _: None)
    old.forget("anything")
    field.kernel.spawn(old.home("cf2"), FLEET, "the old brain")
    field.kernel.spawn(old.bring_down(Down.LAND), FLEET, "the old brain")
    field.kernel.spawn(old.fleet_report(), FLEET, "the old brain")
    field.advance(100)
    assert lost == ["old"]
    assert [field.navigation.flown(f"cf{number}") for number in (1, 2, 3)] == [0, 0, 0]
    with pytest.raises(BadInput, match="another run of this app has taken over"):
        field.link(1)
    new.fly(Task(), lambda _: None)
    field.advance(100)
    assert field.navigation.carrying("cf1") == PILLS


def test_what_a_drone_did_for_an_older_brain_is_broken_off() -> None:
    """It hovers, and the new brain may send it elsewhere; the old one hears no failure."""
    field = Field()
    old = field.link(1)
    fly(field.kernel, old.goes("cf1", THERE))
    errand = field.kernel.spawn(old.home("cf1"), FLEET, "an errand")
    field.advance(5)
    new = field.link(2)
    fly(field.kernel, new.land("cf1"))
    telemetry = field.navigation.telemetry["cf1"]
    assert telemetry.landed
    assert telemetry.location == pytest.approx((2.5, 3, 0))
    assert not errand.is_set


def test_a_gateway_that_crashes_leaves_the_drones_hovering_and_the_ledger() -> None:
    """What had not begun is flown anew; what was done is known; the brain hears of the crash."""
    field, lost, heard = Field(), list[str](), list[object]()
    link = field.link(1, lambda: lost.append("gateway"))
    link.fly(Task(), heard.append)
    link.fly(Task(id="far", drone="cf2", stops=((18, 18, 1.2),)), heard.append)
    field.advance(20)
    assert heard == [None]
    field.gateway.crash()
    field.advance(100)
    assert lost == ["gateway"]
    field.another()
    assert states(called(field)) == {Task().id: JobState.DONE}
    assert not field.navigation.telemetry["cf2"].landed
    link = field.link(99)
    link.fly(Task(id="far", drone="cf2", stops=((18, 18, 1.2),)), heard.append)
    field.advance(100)
    assert heard == [None, None]


@pytest.mark.parametrize(
    ("rebooted", "state"), [(False, JobState.BROKEN_OFF), (True, JobState.BEGUN)]
)
def test_an_action_that_had_begun_is_settled_by_its_drone(rebooted: bool, state: JobState) -> None:
    """If it remembers all since then, it was not done; if it was switched off, that is not known."""
    field, heard = Field(), list[object]()
    field.link(1).fly(Task(), heard.append)
    field.advance(15)
    field.gateway.crash()
    if rebooted:
        field.navigation.reboot("cf1")
    field.another()
    assert states(called(field)) == {Task().id: state}
    field.link(99).fly(job := Task(), heard.append)
    field.advance(100)
    if rebooted:
        (error,) = heard
        assert isinstance(error, FlightFailed)
        assert error.failure is Failure.UNKNOWN
        assert field.deeds == []
        link = field.link(99)
        link.forget(job.id)  # a person has decided
        assert fly(field.kernel, link.recover("cf1"))
        link.fly(job, heard.append)
        field.advance(100)
        assert field.deeds == [job.id]
    else:
        assert (heard, field.deeds) == ([None], [job.id])


def test_a_drone_that_did_it_says_so_even_if_the_ledger_does_not() -> None:
    """The gateway died between the deed and its own note of it."""
    field = Field()
    field.link(1).fly(Task(action="measure", item=None), lambda _: None)
    field.advance(14.5)
    field.navigation.bodies["cf1"].done[Task().id] = 21.5
    field.gateway.crash()
    field.another()
    fleet_report = called(field)
    assert states(fleet_report) == {Task().id: JobState.DONE}
    assert fleet_report.jobs[Task().id].value == 21.5


def test_a_job_broken_off_before_its_action_may_fly_again() -> None:
    """Also one that only hovers, for an action of the app's own."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    link.fly(Task(), heard.append)
    link.fly(Task(id="own", drone="cf2", action=None, item=None), heard.append)
    field.advance(12)
    link.break_off("cf1")
    link.break_off("cf2")
    assert heard == []
    assert states(called(field)) == dict.fromkeys((Task().id, "own"), JobState.BROKEN_OFF)
    link = field.link(99)
    link.fly(Task(id="own", drone="cf2", action=None, item=None), heard.append)
    field.advance(100)
    assert heard == [None]
    assert states(called(field))["own"] is JobState.DONE
    field.link(99).break_off("cf2")
    assert states(called(field))["own"] is JobState.BROKEN_OFF


@pytest.mark.parametrize(
    ("stop", "reason"),
    [
        ((30.0, 5.0, 1.2), "(30, 5) is outside the map: x goes from 0 to 20 m, y from 0 to 20 m"),
        ((3.0, 5.0, 11.0), "(3, 5) at a height of 11 m is above the ceiling of 10 m"),
    ],
)
def test_no_drone_is_sent_where_it_may_not_be(
    stop: tuple[float, float, float], reason: str
) -> None:
    """Against what the brain believes; and it does not move."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    link.fly(Task(stops=(THERE, stop)), heard.append)
    field.advance(100)
    (error,) = heard
    assert isinstance(error, FlightFailed)
    assert (error.failure, str(error)) == (Failure.REFUSED, reason)
    assert field.navigation.flown("cf1") == 0


def test_a_drone_that_flies_gets_no_second_job() -> None:
    """Its brain is told for whom it flies."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    link.fly(Task(), lambda _: None)
    link.fly(Task(id="another"), heard.append)
    field.advance(0)
    assert [str(error) for error in heard] == ["cf1 flies already, for North field/A/0/1"]


def test_who_tells_a_drone_two_things_at_once_is_told_of_the_mistake() -> None:
    """It is the brain's, and no failed flight."""
    field = Field()
    link = field.link(1)
    link.fly(Task(), lambda _: None)
    with pytest.raises(Busy, match="cf1 was told to do something while it does something else"):
        fly(field.kernel, link.land("cf1"))
    field.kernel.close()
    field = Field()
    link = field.link(1)
    fly(field.kernel, link.goes("cf1", THERE))
    field.kernel.spawn(link.home("cf1"), FLEET, "an errand")
    field.advance(1)
    with pytest.raises(Busy, match="cf1 was told to fly while it does something for itself"):
        link.fly(Task(), lambda _: None)
    assert not fly(field.kernel, link.drone_report("cf1")).landed


def test_a_drone_that_was_sent_elsewhere_does_not_hover_there_any_more() -> None:
    """Its job, to be there for an action of the app's own, is open again; holding is no leaving."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    job = Task(action=None, item=None)
    link.fly(job, heard.append)
    field.advance(20)
    holding = field.kernel.spawn(link.hold("cf1"), FLEET, "hold")
    field.advance(1)
    holding.cancel()
    assert states(fly(field.kernel, link.fleet_report())) == {job.id: JobState.DONE}
    fly(field.kernel, link.land("cf1"))
    assert states(fly(field.kernel, link.fleet_report())) == {job.id: JobState.BROKEN_OFF}
    link.fly(job, heard.append)
    field.advance(20)
    assert heard == [None, None]
    assert not field.navigation.telemetry["cf1"].landed


def test_a_client_that_is_cut_off_hears_no_answer() -> None:
    """Neither what it is nor that it failed: silence is all that a lost link gives."""
    field = Field()
    old = field.link(1)
    old.fly(Task(action=None), lambda _: None)
    field.advance(100)
    reads = old.ask("read", "cf1", name="range.front")
    asked = field.kernel.spawn(reads, FLEET, "asked in time")
    field.advance(0)
    field.link(2)
    writes = old.ask("write", "cf1", name="range.front", value=1.0)
    late = field.kernel.spawn(writes, FLEET, "asked too late")
    report = field.kernel.spawn(old.drone_report("cf1"), FLEET, "asked too late as well")
    field.advance(100)
    assert asked.is_set
    assert not late.is_set
    assert not report.is_set
    assert field.navigation.bodies["cf1"].settings == {}


@pytest.mark.parametrize("carried", [True, False])
def test_a_drone_that_cannot_fly_home_is_back_once_it_was_carried_there(
    carried: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where nobody carries it, it is lost."""

    async def fetched(_: object, drone: str) -> bool:
        return carried

    field, heard = Field(), list[object]()
    monkeypatch.setattr(type(field.navigation), "fetched", fetched)
    link = field.link(1)
    link.fly(Task(), heard.append)
    field.advance(5)
    field.navigation.strike("cf1", Failure.BATTERY)
    field.advance(60)
    assert isinstance(heard[0], FlightFailed)
    assert fly(field.kernel, link.recover("cf1")) is carried


def test_a_mishap_is_refused_where_drones_are_real() -> None:
    field = Field()
    why = fly(field.kernel, field.link(1).ask("mishap", "cf1", kind="crash", job=None))
    assert why == "mishaps happen to simulated drones only"
