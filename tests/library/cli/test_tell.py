"""`tell` reaches the app that runs, and says what is wrong where none does."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread

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
def running(note: Path, answer: Callable[[Mapping[str, object]], str]) -> Iterator[None]:
    """Let an app, or its gateway, listen in a thread of its own."""
    ready, over = Event(), Event()

    async def answered(request: Mapping[str, object]) -> str:
        return answer(request)

    async def listen() -> None:
        async with hear_commands(note, answered):
            ready.set()
            await asyncio.to_thread(over.wait)

    thread = Thread(target=lambda: asyncio.run(listen()))
    thread.start()
    ready.wait()
    try:
        yield
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
    ],
)
def test_each_command_arrives_and_the_answer_is_printed(
    words: str, request_: object, journal: Path, command: Command
) -> None:
    heard = []

    def answer(request: Mapping[str, object]) -> str:
        heard.append(request)
        return "so be it"

    with running(commands_note(journal), answer):
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
    heard = []

    def answer(request: Mapping[str, object]) -> str:
        heard.append(request)
        return "they are cut"

    with running(gateway_folder(journal) / NOTE, answer):
        assert command("tell", journal, "cut-motors", *words) == (0, "they are cut\n", "")
    assert heard == [request_]
    assert offline.pending_stop(journal) is None


def test_where_no_gateway_commands_drones_no_motor_is_cut(journal: Path, command: Command) -> None:
    """That is said, and how to reach them."""
    journal.touch()
    code, _, err = command("tell", journal, "cut-motors", "--all")
    assert code == 2
    assert "nothing commands its drones, so no motor can be cut from here" in err
    assert "resume" in err


def test_trips_and_drones_are_taken_from_a_file(
    journal: Path, missions: Path, tmp_path: Path, command: Command
) -> None:
    """As they are written there: what is wrong with them the app tells."""
    fleet = tmp_path / "f.toml"
    fleet.write_text('[[drone]]\nid = "cf9"\nhome = [1, 2]\nuri = "radio://0/80/2M"\n')
    heard = []

    def answer(request: Mapping[str, object]) -> str:
        heard.append(request)
        return "so be it"

    with running(commands_note(journal), answer):
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


def test_what_is_no_list_of_plain_trips_is_refused(tmp_path: Path, command: Command) -> None:
    """An area, a time of day, and more than fits into a command."""
    file = tmp_path / "m.toml"
    for written, said in (
        ("[[mission.area]]\nname = 'x'", "has area: write plain trips (check --write makes them)"),
        ("[[mission.trip]]\nwhen = 08:00:00", "not JSON serializable"),
        ("[[mission.trip]]\nname = 'x'\n" * 5000, "is too long for one command"),
    ):
        file.write_text(f'[[mission]]\nname = "North"\n{written}\n')
        code, _, err = command("tell", tmp_path / "j", "change-trips", "North", "--from", file)
        assert code == 2
        assert said in err


def test_a_refusal_is_exit_2(journal: Path, command: Command) -> None:
    def answer(request: Mapping[str, object]) -> str:
        raise BadInput("there is no mission East")

    with running(commands_note(journal), answer):
        said = command("tell", journal, "pause", "East")
    assert said == (2, "", "there is no mission East\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("stop North", "stop brings all drones down"),
        ("skip", "skip needs the name of a mission"),
        ("pause North A", "pause takes no trip; only skip and prioritise do"),
        ("retire", "retire needs the name of a drone"),
        ("bring-back cf1 A", "bring-back takes no trip"),
        ("prioritise North A", "prioritise needs a mission, a trip of it, and --to N"),
        ("skip North A --to 3", "--to goes with prioritise, not with skip"),
        ("pause --rtl", "--land and --rtl go with stop, not with pause"),
        ("stop --rtl --land", "not allowed with argument"),
        ("cut-motors", "name the drone, or say --all"),
        ("cut-motors cf1 --all", "name the drone, or say --all"),
        ("cut-motors cf1 A", "cut-motors takes no trip"),
        ("stop --all", "--all goes with cut-motors, not with stop"),
        ("change-trips North", "change-trips needs a mission, and --from with a missions file"),
        ("join cf9", "join needs the name of a drone, and --from with a fleet file that has it"),
        ("pause --from m.toml", "--from goes with change-trips and join, not with pause"),
        ("mishap cf1", "mishap needs the name of a drone, and --kind: lost, crash, battery"),
        ("mishap cf1 --kind rain", "invalid choice: 'rain'"),
        ("pause --kind lost", "--kind goes with mishap, not with pause"),
        ("dance", "invalid choice: 'dance'"),
    ],
)
def test_what_makes_no_sense_is_refused(
    words: str, said: str, journal: Path, command: Command
) -> None:
    code, out, err = command("tell", journal, *words.split())
    assert (code, out) == (2, "")
    assert said in err


def test_where_no_app_runs_one_is_told_how_to_go_on(journal: Path, command: Command) -> None:
    journal.touch()
    code, out, err = command("tell", journal, "pause")
    assert (code, out) == (2, "")
    assert err == (
        f"{journal}: alfalfa is not running, so it cannot be told; "
        f"alfalfa resume {journal} goes on\n"
    )


def test_what_is_said_to_be_typed_is_safe_to_type(tmp_path: Path, command: Command) -> None:
    """Under any name of the journal."""
    journal = tmp_path / "a b$(id)"
    journal.touch()
    _, _, err = command("tell", journal, "pause")
    assert err.endswith(f"alfalfa resume '{journal}' goes on\n")


@pytest.mark.parametrize("words", ["stop", "stop --rtl", "pause"])
def test_a_wrong_name_is_not_answered_by_no_drone_flies(
    words: str, journal: Path, command: Command
) -> None:
    said = f"{journal}: there is no such journal\n"
    assert command("tell", journal, *words.split()) == (2, "", said)


def test_a_stop_is_kept_for_the_apps_next_start(journal: Path, command: Command) -> None:
    """It may crash while its drones come down."""
    with running(commands_note(journal), lambda request: "stopping"):
        assert command("tell", journal, "stop", "--rtl") == (0, "stopping\n", "")
        assert offline.pending_stop(journal) is Down.HOME


def test_where_nothing_runs_there_is_nothing_to_stop(journal: Path, command: Command) -> None:
    journal.touch()
    said = f"{journal}: alfalfa is not running, and no drone flies\n"
    assert command("tell", journal, "stop") == (2, "", said)


def test_an_app_that_has_only_just_begun_is_stopped_before_it_flies(
    journal: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It reads its journal, and hears nothing yet: what it shall do is left where it will look."""
    lock, leave = Lock.take(journal), offline.leave_stop
    left, over = Event(), Event()

    def leave_and_tell(journal: Path, how: Down) -> None:
        leave(journal, how)
        left.set()

    def answer(request: Mapping[str, object]) -> str:
        return "stopping"

    def begin() -> None:
        left.wait()
        with running(commands_note(journal), answer):
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
