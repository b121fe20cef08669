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
HUP, INT, TERM = signal.SIGHUP, signal.SIGINT, signal.SIGTERM
HELLO = (
    '{"jsonrpc": "2.0", "id": 1, "method": "initialize",'
    ' "params": {"processId": null, "rootUri": null, "capabilities": {}}}'
)
COMMANDS = {
    "lsp": (("lsp",), "Content-Length"),
    "watch": (("watch", "crop.pluto"), "Ctrl-C ends"),
    "edit": (("edit", "--no-open", "crop.pluto"), "Ctrl-C ends"),
}


def begun(process: Process, command: str) -> None:
    """Wait until it has begun."""
    if command == "lsp":
        assert process.process.stdin is not None
        process.process.stdin.write(f"Content-Length: {len(HELLO)}\r\n\r\n{HELLO}")
        process.process.stdin.flush()
    process.until(COMMANDS[command][1])


@pytest.mark.parametrize(
    ("command", "number", "code"),
    [
        ("lsp", TERM, 143),
        *(
            pytest.param(command, number, code, marks=pytest.mark.long)
            for command, number, code in [
                *(("lsp", HUP, 129), ("lsp", INT, 130), ("watch", HUP, 129), ("watch", INT, 130)),
                *(("watch", TERM, 143), ("edit", HUP, 129), ("edit", INT, 0), ("edit", TERM, 143)),
            ]
        ),
    ],
)
def test_a_signal_ends_it(app: Path, command: str, number: signal.Signals, code: int) -> None:
    words = COMMANDS[command][0]
    with hearing(number, signal.SIG_DFL, "-m", "plutoc", *words) as process:
        begun(process, command)
        assert process.ended(number)[0] == code


@pytest.mark.long
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("number", "then", "code"), [(HUP, TERM, 143), (INT, TERM, 143)])
def test_one_that_its_caller_ignores_is_ignored(
    app: Path, command: str, number: signal.Signals, then: signal.Signals, code: int
) -> None:
    """As with `nohup`, or in the background of a script."""
    with hearing(number, signal.SIG_IGN, "-m", "plutoc", *COMMANDS[command][0]) as process:
        begun(process, command)
        process.send(number)
        assert process.ended(then)[0] == code
