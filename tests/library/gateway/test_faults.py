"""What a simulation can let go wrong between brain, gateway and drones."""

from __future__ import annotations

from pluto_fleet.gateway.lossy_line import LOST, LossyLine
from pluto_fleet.jobs.reports import Down, JobState
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.simulation.radio import ANSWER, COMMAND, Radio
from tests.library.gateway.flights import Field, Task
from tests.library.simulation.flights import fly

SLOW = {COMMAND: 2.0, ANSWER: 3.0}


def over_the_radio(field: Field) -> Radio:
    """Put a slow radio between a gateway and its drones."""
    radio = Radio(field.kernel, field.navigation, SLOW.__getitem__)
    field.gateway = type(field.gateway)(
        field.kernel, radio, field.drones, field.airspace, ledger=field.ledger
    )
    return radio


def test_commands_and_reports_take_a_while_on_a_slow_radio() -> None:
    """The job takes its 16 s, and five more for each of its three commands."""
    field, heard = Field(), list[float]()
    radio = over_the_radio(field)
    field.gateway.link(1).fly(Task(), lambda _: heard.append(field.kernel.now))
    field.advance(100)
    assert (heard, radio.late) == ([31.0], 6)


def test_what_is_on_its_way_can_be_broken_off() -> None:
    """A command that has not arrived never does; an action whose answer is on its way was done."""
    field, heard = Field(), list[object]()
    over_the_radio(field)
    link = field.gateway.link(1)
    link.fly(Task(), heard.append)
    field.advance(1)
    link.break_off("cf1")
    field.advance(50)
    assert (heard, field.navigation.flown("cf1")) == ([], 0)
    link.fly(Task(), heard.append)
    field.advance(29)
    link.break_off("cf1")
    field.advance(50)
    assert heard == []
    fleet_report = fly(field.kernel, link.fleet_report())
    assert fleet_report.jobs[Task().id].state is JobState.DONE


def test_single_commands_are_late_too_and_can_be_broken_off() -> None:
    """Nothing is done to a drone by a command that did not arrive."""
    field = Field()
    radio = over_the_radio(field)
    rising = field.kernel.spawn(radio.takeoff("cf1", 1.2), FLEET, "rise")
    rising.watch(lambda _: None)
    field.advance(1)
    radio.break_off("cf1")
    field.advance(10)
    assert isinstance(rising.error, FlightFailed)
    assert field.navigation.telemetry["cf1"].landed
    fly(field.kernel, radio.takeoff("cf1", 1.2))
    assert field.kernel.now == 11 + 2 + 4 + 3
    fly(field.kernel, field.gateway.link(1).bring_down(Down.LAND))
    assert field.navigation.telemetry["cf1"].landed


def test_a_report_that_is_lost_breaks_the_line_and_is_told_to_the_next_who_attaches() -> None:
    """The brain notices that the line is broken, and asks."""
    field, lost, heard = Field(), list[str](), list[object]()
    fates = iter([LOST, 0.0])
    field.gateway.line = line = LossyLine(field.gateway, lambda: next(fates))
    link = field.gateway.link(1, lambda: lost.append("line"))
    link.fly(Task(), heard.append)
    field.advance(100)
    assert (heard, lost, line.lost) == ([], ["line"], 1)
    field.gateway.link(2).attach(Task().id, heard.append)
    field.advance(0)
    assert heard == [None]


def test_a_late_report_is_not_told_to_a_brain_that_is_gone() -> None:
    """It is of another life."""
    field, heard = Field(), list[object]()
    field.gateway.line = line = LossyLine(field.gateway, lambda: 5.0)
    field.gateway.link(1).fly(Task(), heard.append)
    field.advance(17)
    assert (line.late, heard) == (1, [])
    field.gateway.link(2)
    field.advance(100)
    assert heard == []
