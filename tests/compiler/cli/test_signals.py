"""Each command of `plutoc` that lasts ends at a signal to end, unless its caller has that signal ignored."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from tests.kit.command import Process, hearing

pytestmark = [
    pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals"),
    pytest.mark.process,
]
HUP = signal.SIGHUP
INT = signal.SIGINT
TERM = signal.SIGTERM
HELLO = (
    '{"jsonrpc": "2.0", "id": 1, "method": "initialize",'
    ' "params": {"processId": null, "rootUri": null, "capabilities": {}}}'
)
LASTS = {
    "lsp": ["lsp"],
    "watch": ["watch", "crop.pluto"],
    "edit": ["edit", "--no-open", "crop.pluto"],
}
CODES = {HUP: 129, INT: 130, TERM: 143}


def begun(command: str, number: signal.Signals, how: signal.Handlers) -> Process:
    process = hearing(number, how, "-m", "plutoc", *LASTS[command])
    if command == "lsp":
        assert process.process.stdin is not None
        process.process.stdin.write(f"Content-Length: {len(HELLO)}\r\n\r\n{HELLO}")
        process.process.stdin.flush()
    process.until("Content-Length" if command == "lsp" else "Ctrl-C ends")
    return process


@pytest.mark.parametrize(
    "number", [TERM, *(pytest.param(n, marks=pytest.mark.long) for n in (HUP, INT))]
)
@pytest.mark.parametrize(
    "command", ["lsp", *(pytest.param(one, marks=pytest.mark.long) for one in ("watch", "edit"))]
)
def test_a_signal_ends_it(app: Path, command: str, number: signal.Signals) -> None:
    with begun(command, number, signal.SIG_DFL) as process:
        assert process.ended(number)[0] == (
            0 if (command, number) == ("edit", INT) else CODES[number]
        )


@pytest.mark.long
@pytest.mark.parametrize("number", [HUP, INT])
@pytest.mark.parametrize("command", LASTS)
def test_one_that_its_caller_ignores_is_ignored(
    app: Path, command: str, number: signal.Signals
) -> None:
    """As with `nohup`, or in the background of a script."""
    with begun(command, number, signal.SIG_IGN) as process:
        process.send(number)
        assert process.ended(TERM)[0] == 143
