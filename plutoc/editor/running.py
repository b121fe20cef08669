"""*Run*: an app is compiled into a temporary folder and simulated there, by a process of its own."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from plutoc.editor import moves
from plutoc.editor.asked import Refused
from plutoc.editor.compiling import Snapshot, compiled
from plutoc.editor.sample_plan import sample_plan
from plutoc.emit.errors import place_of
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.project.package import FLEET, MISSIONS, called, with_own_code
from plutoc_runtime.domain.text import duration, printable, quoted

LONGEST = 60.0
"""Seconds of real time that a simulation may take."""
_MOST_TEXT = 20_000

Data = dict[str, object]


async def run(app: Snapshot, missions: str | None, seed: int) -> Data:
    """Simulate an app; raise `Refused` where it has errors, or there are no such missions."""
    app = replace(app, path=app.path.absolute())  # the process runs elsewhere
    plan = _plan_beside(app, missions)
    with TemporaryDirectory(prefix="pluto-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        package, sample = await asyncio.to_thread(_prepared, app, folder)
        fleet = app.path.with_name(FLEET)
        if plan is None:
            plan = folder / MISSIONS
            plan.write_text(sample, encoding="utf-8")
            fleet = folder / FLEET  # there is none: drones on an empty plain
        arguments = ["simulate", os.fspath(plan), f"--seed={seed}"]
        arguments += ["--trace", os.fspath(folder / "trace.jsonl")]
        arguments += ["--fleet", os.fspath(fleet)] if fleet.is_file() else []
        command, environment = called(folder / "app" / "src", package, arguments)
        environment |= {moves.FILE: os.fspath(folder / "moves.jsonl"), "NO_COLOR": "1"}
        code, log = await _ended(command, environment, folder)
        events, cut = await asyncio.to_thread(
            moves.moves_in, folder / "moves.jsonl", folder / "trace.jsonl"
        )
        is_sample = plan.parent == folder
        return {
            "events": events,
            "cut": cut,
            "missions": list(dict.fromkeys(str(event[1]) for event in events)),
            "duration_s": max((float(str(event[0])) for event in events), default=0.0),
            "log": log,
            "exit": code,
            "plan": sample if is_sample else None,
            "file": None if is_sample else plan.name,
        }


def _plan_beside(app: Snapshot, missions: str | None) -> Path | None:
    """Return the missions file beside the source that is meant; None: there is none."""
    if missions is None:
        found = app.path.with_name(MISSIONS)
        return found if found.is_file() else None
    if Path(missions).name != missions or not missions.endswith(".toml"):
        raise Refused("missions must be a file beside the source, such as missions.toml")
    found = app.path.with_name(missions)
    try:
        is_there = found.is_file()
    except OSError:  # no name of a file, such as one of 5,000 characters
        is_there = False
    if not is_there:
        raise Refused(f"there is no {quoted(missions)} beside the source")
    return found


def _prepared(app: Snapshot, folder: Path) -> tuple[str, str]:
    """Write the package, with notes at every block; return its name, and a plan for it."""
    made = compiled(app, optimise=False)
    graph = made.checked.graph
    package = with_own_code(made, app.path)
    home = f"src/{package.name}"
    flow = moves.noting(package.owned[f"{home}/flow.py"], graph.node)
    own = {f"{home}/flow.py": flow, f"{home}/{moves.MODULE}.py": moves.NOTES}
    try:
        texts = replace(package, owned={**package.owned, **own})
        write(compare(texts, folder / "app", place_of(graph)))
    except CannotWrite as error:
        raise Refused(f"the app cannot be compiled there: {printable(str(error))}") from None
    return package.name, sample_plan(graph)


async def _ended(command: list[str], environment: dict[str, str], folder: Path) -> tuple[int, str]:
    """Run a command to its end, or to the end of its time; return its exit code and what it said."""
    process = await asyncio.create_subprocess_exec(
        *command,
        env=environment,
        cwd=folder,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
        start_new_session=True,  # with all that it starts, it can be ended as one
    )
    assert process.stdout is not None
    said = bytearray()
    late = ""
    try:
        async with asyncio.timeout(LONGEST):
            while part := await process.stdout.read(65536):
                said += part
                del said[2 * _MOST_TEXT :]
            await process.wait()
    except TimeoutError:
        late = f"\nThis run was ended after {duration(LONGEST)}."
    finally:
        with suppress(ProcessLookupError):
            if sys.platform == "win32":  # it has no groups
                process.kill()
            else:
                os.killpg(process.pid, signal.SIGKILL)
        await process.wait()
    code = process.returncode or 0
    text = said.decode("utf-8", "replace")
    return code if code >= 0 else 128 - code, text[:_MOST_TEXT] + late
