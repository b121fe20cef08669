"""What a simulation can let go wrong between brain, gateway and drones."""

from __future__ import annotations

from pluto_fleet.gateway.lossy_line import LOST, LossyLine
from pluto_fleet.simulation.radio import ANSWER, COMMAND, Radio
from tests.library.gateway.flights import Field, Task

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
