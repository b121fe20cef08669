"""`tell` reaches the app that runs, and says what is wrong where none does."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from pluto_fleet.flight import offline
from pluto_fleet.flight.commands import hear_commands
from pluto_fleet.gateway.process import NOTE
from pluto_fleet.jobs.reports import Down
from pluto_fleet.journal.lock import Lock
from pluto_fleet.journal.place import commands_note, gateway_folder
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.cli.conftest import Command


@contextmanager
def hearing(note: Path, says: str = "so be it", refuses: str = "") -> Iterator[list[Any]]:
    """Let an app, or its gateway, listen in a thread of its own; yield what it hears."""
    ready, over, heard = Event(), Event(), list[Any]()

    async def answered(request: Mapping[str, object]) -> str:
        heard.append(request)
        if refuses:
            raise BadInput(refuses)
        return says

    async def listen() -> None:
        async with hear_commands(note, answered):
            ready.set()
            await asyncio.to_thread(over.wait)

    thread = Thread(target=lambda: asyncio.run(listen()))
    thread.start()
    ready.wait()
    try:
        yield heard
    finally:
        over.set()
        thread.join()


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    return tmp_path / "a.journal"


@pytest.mark.parametrize(
    ("words", "request_"),
    [
        ("stop", {"command": "stop", "how": "land"}),
        ("stop --land", {"command": "stop", "how": "land"}),
        ("stop --rtl", {"command": "stop", "how": "rtl"}),
        ("pause", {"command": "pause", "mission": None}),
        ("go-on North", {"command": "go-on", "mission": "North"}),
        ("skip North", {"command": "skip", "mission": "North", "trip": None}),
        ("skip North A", {"command": "skip", "mission": "North", "trip": "A"}),
        ("cancel South", {"command": "cancel", "mission": "South"}),
        ("mishap cf1 --kind crash", {"command": "mishap", "drone": "cf1", "kind": "crash"}),
        (
            "event smoke id=a at=3,4 level=0.7 place=wall hot=true --keep 20s",
            {
                "command": "raise-event",
                "event": "smoke",
                "id": "a",
                "at": [3.0, 4.0],
                "fields": {"level": 0.7, "place": "wall", "hot": True},
                "keep": 20.0,
            },
        ),
    ],
)
def test_each_command_arrives_and_the_answer_is_printed(
    words: str, request_: object, journal: Path, command: Command
) -> None:
    with hearing(commands_note(journal)) as heard:
        assert command("tell", journal, *words.split()) == (0, "so be it\n", "")
    assert heard == [request_]


@pytest.mark.parametrize(
    ("words", "request_"),
    [
        (["cf1"], {"do": "cut-motors", "drone": "cf1"}),
        (["--all"], {"do": "cut-motors", "all": True}),
    ],
)
def test_motors_are_cut_by_the_gateway_without_a_word_to_the_app(
    words: list[str], request_: object, journal: Path, command: Command
) -> None:
    """A hook may keep the app busy; and nothing is asked back."""
    with hearing(gateway_folder(journal) / NOTE, "they are cut") as heard:
        assert command("tell", journal, "cut-motors", *words) == (0, "they are cut\n", "")
    assert heard == [request_]
    assert offline.pending_stop(journal) is None


@pytest.mark.parametrize(
    ("fact", "says"),
    [
        ("at=Dock", "at=Dock is no place: write it in metres, like at=3,4"),
        ("level", '"level" is no fact of an event: write it like level=0.7'),
    ],
)
def test_what_cannot_be_said_of_an_event_is_told(
    fact: str, says: str, journal: Path, command: Command
) -> None:
    assert command("tell", journal, "event", "smoke", fact) == (2, "", f"{says}\n")


def test_trips_and_drones_are_taken_from_a_file(
    journal: Path, missions: Path, tmp_path: Path, command: Command
) -> None:
    """As they are written there: what is wrong with them the app tells."""
    fleet = tmp_path / "f.toml"
    fleet.write_text('[[drone]]\nid = "cf9"\nhome = [1, 2]\nuri = "radio://0/80/2M"\n')
    with hearing(commands_note(journal)) as heard:
        assert command("tell", journal, "change-trips", "South", "--from", missions)[0] == 0
        assert command("tell", journal, "join", "cf9", "--from", fleet)[0] == 0
        unknown = command("tell", journal, "join", "cf8", "--from", fleet)
    trip = {"action": "measure", "target": [6, 3]}
    given = {"home": [1, 2], "uri": "radio://0/80/2M"}
    assert heard == [
        {"command": "change-trips", "mission": "South", "trips": [trip]},
        {"command": "join", "drone": "cf9", **given},
    ]
    assert unknown[2] == f'{fleet}: there is no drone "cf8"; there are: "cf9"\n'


def test_times_of_day_arrive_as_texts(journal: Path, tmp_path: Path, command: Command) -> None:
    """A file may have TOML's own, which no command can carry; a date is refused by the app, as a text."""
    file = tmp_path / "m.toml"
    file.write_text(
        '[[mission]]\nname = "North"\ndeadline = 09:00:00\n'
        "[[mission.trip]]\nat = 08:30:00\n[[mission.trip]]\nat = 2026-01-02\n"
    )
    with hearing(commands_note(journal)) as heard:
        said = command("tell", journal, "change-trips", "North", "--from", file)
    assert said == (0, "so be it\n", "")
    assert heard[0]["trips"] == [{"at": "08:30:00"}, {"at": "2026-01-02"}]


def test_trips_that_are_too_many_are_refused(tmp_path: Path, command: Command) -> None:
    """Nor is more than fits into a command."""
    file = tmp_path / "m.toml"
    file.write_text('[[mission]]\nname = "North"\n' + "[[mission.trip]]\nname = 'x'\n" * 5000)
    code, _, err = command("tell", tmp_path / "j", "change-trips", "North", "--from", file)
    assert code == 2
    assert "is too long for one command" in err


def test_a_refusal_is_exit_2(journal: Path, command: Command) -> None:
    with hearing(commands_note(journal), refuses="there is no mission East"):
        said = command("tell", journal, "pause", "East")
    assert said == (2, "", "there is no mission East\n")


def test_a_stop_is_kept_for_the_apps_next_start(journal: Path, command: Command) -> None:
    """It may crash while its drones come down."""
    with hearing(commands_note(journal), "stopping"):
        assert command("tell", journal, "stop", "--rtl") == (0, "stopping\n", "")
        assert offline.pending_stop(journal) is Down.HOME


def test_an_app_that_has_only_just_begun_is_stopped_before_it_flies(
    journal: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It reads its journal, and hears nothing yet: what it shall do is left where it will look."""
    lock, leave = Lock.take(journal), offline.leave_stop
    left, over = Event(), Event()

    def leave_and_tell(journal: Path, how: Down) -> None:
        leave(journal, how)
        left.set()

    def begin() -> None:
        left.wait()
        with hearing(commands_note(journal), "stopping"):
            over.wait()

    monkeypatch.setattr(offline, "leave_stop", leave_and_tell)
    app = Thread(target=begin)
    app.start()
    try:
        assert command("tell", journal, "stop", "--rtl") == (0, "stopping\n", "")
        assert offline.pending_stop(journal) is Down.HOME
    finally:
        over.set()
        app.join()
        lock.release()
