"""Each command of an app that lasts ends at a signal to end, unless its caller has that signal ignored."""

from __future__ import annotations

import signal
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.kill.trial import end_gateway
from tests.kit.apps import EXAMPLES, compiled_file
from tests.kit.command import Process, hearing

pytestmark = [pytest.mark.long, pytest.mark.process]
HUP, INT, TERM = signal.SIGHUP, signal.SIGINT, signal.SIGTERM
APP = "pm10"
FILES = EXAMPLES / APP
MISSIONS = (str(FILES / "missions.toml"), "--fleet", str(FILES / "fleet.toml"))
FLY = ("fly", *MISSIONS, "--sim", "--journal", "J")
COMMANDS: dict[str, tuple[Sequence[str], str, dict[signal.Signals, int]]] = {
    "simulate": (
        ("simulate", *MISSIONS, "--runs", "100000"),
        "seed 0",
        {HUP: -1, INT: 130, TERM: -15},
    ),
    "fly": (FLY, "launched", {HUP: 129, INT: 130, TERM: 143}),
    "supervise": ((*FLY, "--supervise"), "launched", {HUP: 129, INT: 130, TERM: 143}),
    "serve": (
        ("serve", "--sim", *MISSIONS[1:], "--port", "0", "--folder", "F"),
        "station:",
        {HUP: 129, INT: 130, TERM: 143},
    ),
}


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return compiled_file(FILES / "app.pluto", tmp_path_factory.mktemp("package")) / "src"


def started(here: Path, command: str, number: signal.Signals, how: signal.Handlers) -> Process:
    words, begun, _ = COMMANDS[command]
    process = hearing(number, how, "-u", "-m", APP, *words, cwd=here)
    process.until(begun)
    return process


@pytest.fixture
def here(tmp_path: Path, package: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.syspath_prepend(str(package))
    return tmp_path


@pytest.mark.parametrize("number", [HUP, INT, TERM])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_signal_ends_it(here: Path, command: str, number: signal.Signals) -> None:
    with started(here, command, number, signal.SIG_DFL) as process:
        assert process.ended(number)[0] == COMMANDS[command][2][number]
    end_gateway(here / "J")


@pytest.mark.parametrize("number", [HUP, INT])
@pytest.mark.parametrize("command", COMMANDS)
def test_one_that_its_caller_ignores_is_ignored(
    here: Path, command: str, number: signal.Signals
) -> None:
    """As with `nohup`, or in the background of a script."""
    with started(here, command, number, signal.SIG_IGN) as process:
        process.send(number)
        assert process.ended(TERM)[0] == COMMANDS[command][2][TERM]
    end_gateway(here / "J")
