"""The command line of a generated package."""

from __future__ import annotations

import os
import sys
from functools import partial
from importlib import import_module

from ..process.exit_code import BAD_INPUT, INTERNAL, exit_code
from ..shared import output

TYPE_CHECKING = False  # `typing` itself is slow to import, and plutoc's `--version` does without
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, NoReturn

    from ..app import App

_MODULES = {"check": "plans", "decide": "tell", "resume": "fly"}
"""Where a command is whose module is not called as it is."""

_WITHOUT_HOOKS = (["tell"], ["journal"], ["--version"])
"""Commands that need only an app's name, but for events: a Stop must work even if hooks.py does not."""


def start(name: str, load: Callable[[], object], package: str, seam: int) -> int:
    """Load an app and run the command that the program was called with."""
    code = exit_code(name, partial(_run, name, load, package, seam))
    if code == BAD_INPUT and "--supervised" in sys.argv:
        from .supervise import refuse

        refuse()  # it must not be started again
    from .shutdown import leave_in_time

    leave_in_time(name, code)
    return code


def _run(name: str, load: Callable[[], object], package: str, seam: int) -> int:
    from ..app import bare, described
    from ..process.forked import end_if_forked, refused
    from ..process.signal_guard import guard_hooks, interrupted_by_a_person
    from ..shared.hooks.loading import loaded

    guard_hooks()
    parent = os.getpid()
    if sys.argv[1:2] in _WITHOUT_HOOKS and "event" not in sys.argv:
        return _heard(bare(name, package, seam))
    with interrupted_by_a_person(), refused():
        given = loaded(load)
    end_if_forked(parent)  # as its hooks were loaded
    return _heard(described(given))


def _heard(app: App) -> int:
    """Run the program's command, guarded against hooks that raise `KeyboardInterrupt` or exit."""
    from ..process.forked import instead_of, refused
    from ..process.signal_guard import interrupted_by_a_person

    command = sys.argv[1:2]
    if command in (["simulate"], ["size"]):
        with interrupted_by_a_person(), refused():
            return main(app)
    if command in (["fly"], ["resume"], ["serve"]):
        instead_of(partial(_ended_by_hooks, app.name))
    if command == ["fly"]:  # it calls hooks in the main thread, where interrupts arrive
        with interrupted_by_a_person():
            return main(app)
    return main(app)


def _ended_by_hooks(name: str, status: int) -> NoReturn:
    """Exit as after a crash: drones may be flying, and `--supervise` restarts the app."""
    from ..process.forked import leave

    output.tell(f"{name}: something in the app's own code ends it by os._exit({status})")
    leave(INTERNAL)


def main(app: Any, argv: Sequence[str] | None = None) -> int:
    """Run one command of an app, as its package describes it; return its exit code.

    `argv` is without the program.
    """
    from ..app import described

    output.prepare()
    return exit_code(app.name, lambda: _command(described(app), argv))


def _command(app: App, argv: Sequence[str] | None) -> int:
    from .options import parse

    try:
        options = parse(app, argv)
    except SystemExit as end:  # argparse has printed the help, or what is wrong
        return end.code if isinstance(end.code, int) else BAD_INPUT
    from .plans import take_fleet_beside

    take_fleet_beside(options)
    name = "dry_run" if options.dry_run else options.command
    module = import_module(f".{_MODULES.get(name, name)}", __package__)
    return int(getattr(module, name)(app, options))
