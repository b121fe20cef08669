"""A program that may open the gateway's socket can say what it likes: nothing breaks."""

from __future__ import annotations

import json
import os
import signal
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.gateway.process import NOTE
from pluto_fleet.gateway.starting import start, stop_directly
from pluto_fleet.gateway.wire import MAX_COMMAND
from pluto_fleet.jobs.reports import Down
from pluto_fleet.process.ipc import NotRunning, address_in
from tests.library.gateway.processes import COMMAND, InsideBrain, played_inside
from tests.library.gateway.processes import settings as gateway_settings


def said(folder: Path, *sessions: tuple[bytes, ...]) -> list[list[dict[str, Any]]]:
    """Say lines to a gateway, each session through a connection of its own; return all answers."""
    answers: list[list[dict[str, Any]]] = []

    async def play(brain: InsideBrain) -> None:
        await brain.begins()
        for lines in sessions:
            answers.append(await brain.tells(*lines))

    played_inside(folder, play)
    return answers


def message(**facts: object) -> bytes:
    return json.dumps(facts).encode() + b"\n"


LINK = message(do="link", epoch=1)
HOME = message(do="home", drone="cf1", id=1)
FLY = {
    "do": "fly",
    "id": 1,
    "drone": "cf1",
    "flight": "a/b/0/1",
    "stops": [[4.0, 4.0, 1.0]],
    "action": None,
    "parameters": {},
    "item": None,
    "seconds": 0.0,
    "beside": False,
}


@pytest.mark.parametrize(
    ("lines", "why"),
    [
        ((b"hello\n",), "that is not a line of JSON with an object"),
        ((b"\xff\xfe\n",), "that is not a line of JSON with an object"),
        ((message(do="dance"),), "this gateway does not know that message"),
        ((message(do="link", epoch="1"),), "this gateway does not know that message"),
        ((LINK, LINK), "this connection commands already"),
        ((LINK, message(do="land", drone="x", id=1)), "there is no drone 'x'"),
        ((LINK, message(do="land", drone=["x"], id=1)), "that message is not complete"),
        ((LINK, message(do="land", drone="cf1")), "that message is not complete: KeyError: 'id'"),
        ((LINK, message(do="land", drone="cf1", id=[1])), "that message is not complete"),
        ((LINK, message(do="fly", id=1)), "that message is not complete"),
        ((LINK, message(**{**FLY, "seconds": 10**400})), "is not complete"),
        ((LINK, message(**{**FLY, "item": {"name": "pills"}})), "is not complete"),
        ((LINK, message(**{**FLY, "stops": [[1.0, 1.0]]})), "is not complete"),
        ((LINK, HOME, HOME), "too much is under way"),
        ((LINK, message(do="down", how="up", id=1)), "that message is not complete"),
        ((LINK, message(do="takeoff", drone="cf1", height=1.0, id=1)), "cannot 'takeoff'"),
        ((LINK, message(do="somersault", drone="cf1", id=1)), "this gateway cannot 'somersault'"),
        ((b'{"do": "' + b"x" * MAX_COMMAND + b'"}\n',), "a line was longer than"),
    ],
)
def test_what_makes_no_sense_is_refused_and_logged(
    tmp_path: Path, lines: tuple[bytes, ...], why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """In words; the client may go on, but for lines without an end."""
    [answers] = said(tmp_path, lines)
    [refusal] = [answer for answer in answers if answer.get("ok") is False]
    assert why in refusal["said"]
    assert f"refused: {refusal['said']}" in capsys.readouterr().err


def test_numbers_that_are_none_move_no_drone(tmp_path: Path) -> None:
    """Not a number, or endless: outside the map."""
    [answers] = said(
        tmp_path,
        (
            LINK,
            message(**{**FLY, "stops": [[nan, 1.0, 1.0]]}),
            message(**{**FLY, "id": 2, "stops": [[1.0, 1.0, inf]]}),
        ),
    )
    failed = {answer["failed"]: answer["reason"] for answer in answers if "failed" in answer}
    assert "is outside the map" in failed[1]
    assert "above the ceiling" in failed[2]


def test_it_is_said_when_there_is_no_gateway(tmp_path: Path) -> None:
    """A person who wants the drones down is told so."""
    with pytest.raises(NotRunning):
        stop_directly(tmp_path, Down.LAND, 1)


@pytest.mark.long
def test_it_ends_when_it_is_told_to(tmp_path: Path) -> None:
    """As a system that shuts down tells it."""
    process = start(tmp_path, gateway_settings(patience=0.1), COMMAND)
    while address_in(tmp_path / NOTE) is None:
        assert process.poll() is None
    os.kill(process.pid, signal.SIGHUP)
    process.terminate()
    assert process.wait(10) == 0
    assert address_in(tmp_path / NOTE) is None
