"""Each command of an app that lasts ends at a signal to end, unless its caller has that signal ignored."""

from __future__ import annotations

import signal
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.kill.trial import end_gateway
from tests.kit.apps import EXAMPLES, compiled_file
from tests.kit.command import hearing

pytestmark = [pytest.mark.long, pytest.mark.process]
HUP = signal.SIGHUP
INT = signal.SIGINT
TERM = signal.SIGTERM
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


@pytest.mark.parametrize("number", [HUP, INT, TERM])
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("how", [signal.SIG_DFL, signal.SIG_IGN])
def test_a_signal_ends_it_that_is_not_ignored(
    package: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    command: str,
    number: signal.Signals,
    how: signal.Handlers,
) -> None:
    """Ignored it is with `nohup`, or in the background of a script."""
    monkeypatch.syspath_prepend(str(package))
    words, begun, codes = COMMANDS[command]
    last = TERM if how is signal.SIG_IGN else number
    if number is TERM and how is signal.SIG_IGN:
        last = INT
    with hearing(number, how, "-u", "-m", APP, *words, cwd=tmp_path) as process:
        process.until(begun)
        process.send(number)
        assert process.ended(None if last is number else last)[0] == codes[last]
    end_gateway(tmp_path / "J")
