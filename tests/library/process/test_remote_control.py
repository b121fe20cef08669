"""A running app hears commands, from its owner alone."""

from __future__ import annotations

import asyncio
import errno
import json
import os
import socket
import stat
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.flight.commands import hear_commands, perform
from pluto_fleet.jobs.reports import Down
from pluto_fleet.journal.place import commands_note
from pluto_fleet.process.ipc import (
    MAX_LINE,
    AnswerLost,
    NotRunning,
    address_in,
    ask,
    publish,
)
from pluto_fleet.shared.domain.errors import BadInput


class Told:
    """An app that writes down what it is told, and knows one mission."""

    def __init__(self) -> None:
        self.calls: list[tuple[object, ...]] = []

    def __getattr__(self, name: str) -> Callable[..., str]:
        def said(*given: object) -> str:
            if name == "decide" and given[0] != "North":
                raise BadInput(f"there is no mission {given[0]}")
            self.calls.append((name, *given))
            return f"did {name}"

        return said


def talk(
    note: Path, answer: Callable[[Mapping[str, object]], str], client: Callable[[], object]
) -> object:
    """Let an app listen while a client talks to it."""

    async def answered(request: Mapping[str, object]) -> str:
        return answer(request)

    async def scenario() -> object:
        async with hear_commands(note, answered):
            return await asyncio.to_thread(client)

    return asyncio.run(scenario())


@pytest.fixture
def note(tmp_path: Path) -> Path:
    return commands_note(tmp_path / "a.journal")


@pytest.mark.parametrize(
    ("request_", "call"),
    [
        ({"command": "stop", "how": "rtl"}, ("stop", Down.HOME)),
        (
            {"command": "prioritise", "mission": "North", "trip": "A", "priority": 5},
            ("prioritise", "North", "A", 5),
        ),
        ({"command": "retire", "drone": "cf1"}, ("retire", "cf1")),
        ({"command": "bring-back", "drone": "cf1"}, ("bring_back", "cf1")),
        (
            {"command": "change-trips", "mission": "North", "trips": [{"name": "A"}]},
            ("change_trips", "North", [{"name": "A"}], None),
        ),
        (
            {"command": "change-trips", "mission": "North", "trips": [], "replaces": ["A"]},
            ("change_trips", "North", [], ["A"]),
        ),
        (
            {"command": "join", "drone": "cf9", "home": [1, 2], "uri": None},
            ("join", {"id": "cf9", "home": [1, 2]}),
        ),
        (
            {"command": "mishap", "drone": "cf1", "kind": "crash"},
            ("mishap", "cf1", "crash"),
        ),
        ({"command": "stop", "how": "land"}, ("stop", Down.LAND)),
        ({"command": "pause", "mission": None}, ("pause", None)),
        ({"command": "go-on", "mission": "North"}, ("go_on", "North")),
        ({"command": "skip", "mission": "North", "trip": None}, ("skip", "North", None)),
        ({"command": "cancel", "mission": "North"}, ("cancel", "North")),
        ({"command": "decide", "mission": "North", "answer": "done"}, ("decide", "North", "done")),
    ],
)
def test_each_command_reaches_the_app(
    request_: dict[str, object], call: tuple[object, ...]
) -> None:
    told: Any = Told()
    assert perform(told, request_) == f"did {call[0]}"
    assert told.calls == [call]


@pytest.mark.parametrize(
    "request_",
    [
        {"command": "stop", "how": "crash"},
        {"command": "skip", "mission": None, "trip": None},
        {"command": "decide", "mission": "North", "answer": 1},
        {"command": "change-trips", "mission": "North", "trips": {}},
        {"command": "mishap", "drone": "cf1", "kind": "rain"},
        {"command": "__init__"},
        {},
    ],
)
def test_what_makes_no_sense_is_refused(request_: dict[str, object]) -> None:
    told: Any = Told()
    with pytest.raises(BadInput, match="does not know that command"):
        perform(told, request_)
    assert told.calls == []


@pytest.mark.parametrize(
    "line",
    [
        b"[1]\n",
        b"\xff\xfe\n",
        b"x" * (MAX_LINE + 10) + b"\n",
    ],
    ids=lambda line: repr(line[:8]),
)
def test_a_strangers_line_is_answered_and_does_no_harm(line: bytes, note: Path) -> None:
    """The next one is heard as well."""
    told: Any = Told()

    def client() -> str:
        address = address_in(note)
        assert address is not None
        with socket.socket(socket.AF_UNIX) as stranger:
            stranger.settimeout(5)
            stranger.connect(str(address))
            try:
                stranger.sendall(line)
                assert json.loads(stranger.recv(MAX_LINE))["ok"] is False
            except ConnectionError:  # it has hung up on who talks too much
                assert len(line) > MAX_LINE
        return ask(note, {"command": "pause", "mission": None}, 5)

    assert talk(note, lambda asked: perform(told, asked), client) == "did pause"


def test_without_an_app_it_is_said_that_none_is_there(note: Path) -> None:
    """Nor after it has ended."""
    with pytest.raises(NotRunning):
        ask(note, {}, 5)
    talk(note, lambda asked: "", lambda: None)
    assert not note.exists()
    with pytest.raises(NotRunning):
        ask(note, {}, 5)


def test_an_app_that_ends_first_leaves_one_in_doubt(note: Path) -> None:
    """That is told, and not that all went well."""
    asked, over = asyncio.Event(), asyncio.Event()

    async def never(request: Mapping[str, object]) -> str:
        asked.set()
        await over.wait()
        return "done"

    async def scenario() -> None:
        async with hear_commands(note, never):
            doubt = asyncio.create_task(asyncio.to_thread(ask, note, {"command": "pause"}, 5.0))
            await asked.wait()
        with pytest.raises(AnswerLost, match="before it could say whether that was done"):
            await doubt

    asyncio.run(scenario())


def test_nothing_flies_that_could_not_be_stopped(
    note: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where there is no room to say where commands are heard; nothing of the attempt is left."""

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(BadInput, match="and so nothing flies: the disk is full; mend that"):
        talk(note, lambda asked: "", lambda: None)
    assert list(note.parent.iterdir()) == []


def test_only_the_owner_may_enter_the_folder(note: Path) -> None:
    def client() -> int:
        address = address_in(note)
        assert address is not None
        return stat.S_IMODE(address.parent.stat().st_mode)

    assert talk(note, lambda asked: "", client) == 0o700


def test_a_folder_that_others_may_enter_is_not_trusted(note: Path, tmp_path: Path) -> None:
    """A stranger could have put the socket there."""
    (tmp_path / "open").mkdir()
    (tmp_path / "open").chmod(0o755)
    publish(note, tmp_path / "open" / "s")
    assert address_in(note) is None
