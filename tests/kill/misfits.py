"""An app whose hooks misbehave in every way there is, beside missions that must not notice.

What its action does is the name of its trip, and which process it must not do it in again.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tests.kill.plans import TRIP, Plan, plan, source_of

HOOKS = '''"""Hooks that misbehave as the name of a trip says."""

import asyncio
import atexit
import multiprocessing
import os
import signal
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from threading import Event

HERE = Path(os.environ["FLIGHT"])
FORK = multiprocessing.get_context("fork")
KEPT = []


def once(name):
    """Whether this was never done before, by an earlier life either."""
    try:
        (HERE / f"{name}.done").open("x").close()
    except FileExistsError:
        return False
    return True


def lives_for_ever():
    while True:
        signal.pause()


async def ended_child(context):
    """Start children in each way, end them, and let one live on beside the app."""
    for way in ("fork", "spawn", "forkserver"):
        child = multiprocessing.get_context(way).Process(target=signal.pause, daemon=True)
        child.start()
        child.terminate()
        while child.is_alive():
            await asyncio.sleep(0.01)
    child = subprocess.Popen([sys.executable, "-S", "-c", "import signal; signal.pause()"])
    child.terminate()
    child.wait()
    killed = []
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        pid = os.fork()
        if not pid:
            lives_for_ever()
        os.kill(pid, number)
        _, status = os.waitpid(pid, 0)
        killed.append(os.waitstatus_to_exitcode(status) != 0)
    (HERE / "killed").write_text(str(killed))
    lasting = FORK.Process(target=lives_for_ever, daemon=True)
    lasting.start()
    (HERE / "lasting").write_text(str(lasting.pid))


async def comes_back(context):
    """Fork, and let both come back into the app."""
    pid = os.fork()
    await context.sleep(0.1)
    if pid:
        _, status = os.waitpid(pid, 0)
        (HERE / "came_back").write_text(str(os.waitstatus_to_exitcode(status)))


async def ends_its_task():
    """Leave, in a task of its own."""
    raise SystemExit(0)


async def holds_on():
    """Wait for ever, cancelled or not."""
    while True:
        try:
            await asyncio.Event().wait()
        except BaseException:
            pass


def leaves_behind(name):
    """Leave what Python would wait for behind: threads, processes, tasks, what is done at the end."""
    if name == "executor":
        KEPT.append(ThreadPoolExecutor())
        KEPT[-1].submit(Event().wait)
    elif name == "pool":
        KEPT.append(ProcessPoolExecutor(mp_context=FORK))
        KEPT[-1].submit(signal.pause)
    elif name == "thread":
        asyncio.get_running_loop().run_in_executor(None, Event().wait)
    elif name == "task":
        KEPT.append(asyncio.create_task(holds_on()))
    elif name == "ends":
        KEPT.append(asyncio.create_task(ends_its_task()))
        KEPT[-1].add_done_callback(lambda task: task.exception())
    elif name == "stops":
        asyncio.get_running_loop().call_soon(asyncio.get_running_loop().stop)
    elif name == "atexit":
        atexit.register(Event().wait)
    elif name == "says all is well" and once(name):
        atexit.register(os._exit, 0)


RAISED = {
    "exit": lambda: SystemExit(0),
    "interrupt": KeyboardInterrupt,
    "shout": lambda: ValueError("x" * 5_000_000),
}


async def act(drone, trip, context):
    """Misbehave, if the trip's name says so."""
    await context.sleep(0.5)
    name = trip.name
    if name in RAISED:
        raise RAISED[name]()
    leaves_behind(name)
    if name == "children":
        await ended_child(context)
    if name == "forks":
        await comes_back(context)
    if name.startswith("leaves") and once(name):
        os._exit(int(name.removeprefix("leaves")))
    return 1


def dig(drone, trip, context):
    """The same, in a thread."""
    leaves_behind(trip.name)
    if trip.name in RAISED:
        raise RAISED[trip.name]()
    return 1


'''

RAISED = ("exit", "interrupt", "shout")
"""What its hooks raise: each fails one mission, and says why."""


def misfits_in(folder: Path) -> Path:
    """Compile the app into a folder, and return the one that it is imported from."""
    return source_of("misfits", HOOKS, folder)


INNOCENT = ("innocent", (("one", "act"), ("two", "dig"), ("three", "act")))


def plan_of(*missions: tuple[str, Sequence[tuple[str, str]]]) -> Plan:
    """Return a plan of these missions, by their trips' names and actions, and an innocent one."""
    text = ""
    for number, (mission, trips) in enumerate((*missions, INNOCENT)):
        text += f'[[mission]]\nname = "{mission}"\n'
        for place, (name, action) in enumerate(trips):
            x, y = 0.5 + number % 5, 1.5 + (number + place) % 2
            text += TRIP.format(name=name, action=action, x=x, y=y, more="")
    return plan("misfits", missions=text)
