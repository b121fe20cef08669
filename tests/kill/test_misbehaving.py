"""Hooks that misbehave in every way there is, in real flights under a supervisor: their missions alone notice.

What a hook does is the name of its trip, and which process it must not do it in again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest

from pluto_fleet.journal.reader import standing_of
from tests.kill.lives import Flight, alive, eventually
from tests.kill.plans import TRIP, Plan, plan, source_of
from tests.kill.trial import end_gateway, gateway_of

pytestmark = pytest.mark.long  # ten seconds each, of real processes

HOOKS = '''"""Hooks that misbehave as the name of a trip says."""

import asyncio
import atexit
import multiprocessing
import os
import signal
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

LONGEST_OUTPUT = 400_000
"""Bytes that a flight may print, no matter what its hooks say."""

Trips = Sequence[tuple[str, str]]
Missions = Sequence[tuple[str, Trips]]

INNOCENT = ("innocent", (("one", "act"), ("two", "dig"), ("three", "act")))


def plan_of(missions: Missions) -> Plan:
    """Return a plan of these missions, by their trips' names and actions, and an innocent one."""
    text = ""
    for number, (mission, trips) in enumerate((*missions, INNOCENT)):
        text += f'[[mission]]\nname = "{mission}"\n'
        for place, (name, action) in enumerate(trips):
            x, y = 0.5 + number % 5, 1.5 + (number + place) % 2
            text += TRIP.format(name=name, action=action, x=x, y=y, more="")
    return plan("misfits", missions=text)


@pytest.fixture(scope="session")
def misfits(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app whose hooks misbehave is imported from."""
    return source_of("misfits", HOOKS, tmp_path_factory.mktemp("misfits"))


@contextmanager
def flown(source: Path, folder: Path, missions: Missions, *words: str) -> Iterator[Flight]:
    """Fly missions and the innocent one; no process is left."""
    plan_of(missions).write(folder)
    flight = Flight(app="misfits", source=source, folder=folder, speed=20.0)
    try:
        flight.start(*words)
        yield flight
    finally:
        flight.end()
        end_gateway(flight.journal)


def alone(*hooks: tuple[str, str]) -> Missions:
    """Return a mission each for these actions of trips of this name."""
    return [(f"{action} {name}", ((name, action),)) for action, name in hooks]


RAISED = [(hook, name) for hook in ("act", "dig") for name in ("exit", "interrupt", "shout")]
LEFT = [("dig", name) for name in ("executor", "pool", "atexit")]
LEFT += [("act", name) for name in ("thread", "task", "ends", "stops")]
LEAVES = [(name, ((name, "act"), ("after", "act"))) for name in ("leaves0", "leaves143")]


@pytest.mark.parametrize(
    ("missions", "fails", "lives"),
    [
        pytest.param(alone(*RAISED), [f"{hook} {name}" for hook, name in RAISED], 1, id="raise"),
        pytest.param(alone(*LEFT), [], 1, id="leave threads, processes and tasks behind"),
        pytest.param(LEAVES, [], 3, id="end the process"),
        pytest.param(
            alone(("act", "exit"), ("dig", "says all is well")),
            ["act exit"],
            2,
            id="say it is over",
        ),
    ],
)
def test_all_other_missions_fly_on(
    missions: Missions, fails: list[str], lives: int, misfits: Path, tmp_path: Path
) -> None:
    """The exit code is right, reasons are given, and no process is left running."""
    with flown(misfits, tmp_path, missions, "--supervise") as flight:
        assert flight.see_through() == (1 if fails else 0)
        said, records = flight.lives[-1], ends(flight)
        assert {name for name, record in records.items() if record["status"] == "FAILED"} == {
            *fails
        }
        others = [record["status"] for name, record in records.items() if name not in fails]
        assert others == ["COMPLETED"] * (len(missions) + 1 - len(fails))
        assert all(records[name]["reason"] for name in fails)
        assert said.count("it is started again") == lives - 1
        assert "internal error" not in said and len(said) < LONGEST_OUTPUT
        assert "Traceback" not in said or "raised" in said
        assert eventually(lambda: gateway_of(flight.journal) is None)


def ends(flight: Flight) -> dict[str, dict[str, object]]:
    return standing_of(flight.journal).missions


def test_a_hook_s_children_end_without_the_app_and_with_it(misfits: Path, tmp_path: Path) -> None:
    """Whether they are killed, come back into the app, or would live for ever."""
    missions = [(name, ((name, "act"), ("after", "act"))) for name in ("children", "forks")]
    with flown(misfits, tmp_path, missions, "--supervise") as flight:
        assert flight.see_through() == 0
        assert (tmp_path / "killed").read_text() == "[True, True, True]"
        assert (tmp_path / "came_back").read_text() == "1"
        lasting = int((tmp_path / "lasting").read_text())
        assert eventually(lambda: not alive(lasting))


def test_a_hook_that_ends_the_process_ends_no_flight_as_if_it_were_over(
    misfits: Path, tmp_path: Path
) -> None:
    """It is not supervised: the exit code is that of a crash. In a simulation one mission fails."""
    with flown(misfits, tmp_path, LEAVES[:1]) as flight:
        assert flight.see_through() == 70
        assert "ends it by os._exit(0)" in flight.lives[-1]
    (tmp_path / "leaves0.done").unlink()
    simulated = flight.run("simulate", *flight.files)
    assert simulated.code == 1
    assert "hook act raised SystemExit: os._exit(0)" in simulated.out
    assert "1 of 2 missions completed, 1 failed" in simulated.out
