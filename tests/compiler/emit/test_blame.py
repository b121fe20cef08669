"""An error that escapes from a generated flow says in which block it arose."""

from __future__ import annotations

import itertools
import traceback
from collections.abc import Callable, Coroutine, Iterator, Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from plutoc.block import Block
from plutoc.compile import planned
from plutoc.emit.package import emit
from plutoc.registry import STD, Blocks
from plutoc_blocks import BLOCKS
from plutoc_runtime.flow.blame import blame, blamed
from tests.compiler.emit import failing
from tests.compiler.emit.plans import checked_of

Flow = Callable[[frozenset[str]], Coroutine[Any, Any, Any]]

STEPS: Mapping[str, Callable[..., Any]] = {
    "DroneAllocator": failing.allocate,
    "TripLauncher": failing.launch,
    "TripMonitor": failing.watch,
    "TimerMonitor": failing.watch,
    "GateFIFO": failing.first,
    "GateFunnel": failing.both,
}

APP = """\
pluto 1
app blamed_{number} {{
  create = MissionCreator
  allocate_with_a_name_for_which_there_is_no_room_in_a_line = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  timer = TimerMonitor
  first = GateFIFO
  note = MissionModifier
  tell = MissionModifier
  twice = MissionModifier
  both = GateFunnel
  start -> create -> allocate_with_a_name_for_which_there_is_no_room_in_a_line -> launch
  launch -> [watch, timer] -> first
  first -> allocate_with_a_name_for_which_there_is_no_room_in_a_line when STANDBY
  first -> end when FAILED
  first -> [note, tell] when COMPLETED
  tell -> twice
  [note, twice] -> both -> end
}}
"""
NUMBERS = itertools.count()

DECLARATIONS = {
    "create": "create = MissionCreator",
    "allocate_with_a_name_for_which_there_is_no_room_in_a_line": (
        "allocate_with_a_name_for_which_there_is_no_room_in_a_line = DroneAllocator"
    ),
    "launch": "launch = TripLauncher",
    "watch": "watch = TripMonitor",
    "timer": "timer = TimerMonitor",
    "first": "launch -> [watch, timer] -> first = GateFIFO",
    "note": "note = MissionModifier",
    "tell": "tell = MissionModifier",
    "twice": "twice = MissionModifier",
    "both": "first -> [note, tell] -> both = GateFunnel",
}
BEFORE_THE_WAIT = tuple(DECLARATIONS)[:3]


def blocks() -> Blocks:
    """Return our blocks with steps that fail when asked to."""
    made = {block.name: _failing(block) for block in BLOCKS}
    return Blocks(packages=(STD,), of=lambda _: made)


def _failing(block: Block) -> Block:
    made = replace(
        block,
        step=STEPS.get(block.name, failing.hand_on),
        params=(),
        needs=(),
        uses=(),
        named=block.limits or not (block.watches or block.gate),
    )
    return replace(made, limit=failing.limit) if block.limits else made


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Flow]:
    """The flow of a package of the plain plan."""
    yield from _flow(tmp_path_factory.mktemp("plain"), optimise=False)


@pytest.fixture(scope="module")
def optimised(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Flow]:
    """The flow of an optimised package."""
    yield from _flow(tmp_path_factory.mktemp("optimised"), optimise=True)


def _flow(folder: Path, *, optimise: bool) -> Iterator[Flow]:
    """Write a package, import it, and yield its flow."""
    text = APP.format(number=next(NUMBERS))
    plan = planned(checked_of(text, blocks()), optimise=optimise)
    package = emit(plan, source_name="app.pluto", picture="flowchart TD\n", graph_data="")
    for path, text in {**package.owned, **package.once}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder / "src")
        flow: Flow = import_module(f"{package.name}.flow").flow
        yield flow


def error_of(flow: Flow, *failing_blocks: str) -> Exception:
    """Return what a mission dies of when these blocks fail."""
    with pytest.raises((ZeroDivisionError, AttributeError)) as raised:
        flow(failing.Failing(failing_blocks)).send(None)
    return raised.value


@pytest.mark.parametrize("block", DECLARATIONS)
def test_the_block_that_raised_is_quoted(block: str, plain: Flow) -> None:
    """In branches of forks too, and the gate is told from what it closes."""
    assert blamed(error_of(plain, block), plain) == DECLARATIONS[block]


@pytest.mark.parametrize("block", BEFORE_THE_WAIT)
def test_an_optimised_flow_quotes_the_same(block: str, optimised: Flow) -> None:
    """A declaration stands above a block's call, however many lines that takes."""
    assert blamed(error_of(optimised, block), optimised) == DECLARATIONS[block]


def test_a_wait_of_many_blocks_is_quoted_as_a_whole(optimised: Flow) -> None:
    """What is no mission fails in the wait itself; a limit's own declaration is quoted."""
    assert blamed(error_of(optimised), optimised) == DECLARATIONS["first"]
    assert blamed(error_of(optimised, "timer"), optimised) == DECLARATIONS["timer"]


def test_the_traceback_ends_with_the_block(plain: Flow) -> None:
    """The error is printed with its block."""
    error = error_of(plain, "launch")
    blame(error, plain)
    printed = "".join(traceback.format_exception(error)).splitlines()
    assert printed[-2:] == ["ZeroDivisionError: launch", "in block launch = TripLauncher"]


def test_an_error_from_elsewhere_is_nobodys_fault(plain: Flow) -> None:
    """Without a frame of the flow there is nothing to say, and nothing is added."""
    error = ZeroDivisionError("elsewhere")
    blame(error, plain)
    assert not blamed(error, plain)
    assert not hasattr(error, "__notes__")


def test_what_is_no_function_of_a_file_is_nobodys_fault(plain: Flow) -> None:
    """A flow may be any callable; only one with code of its own has lines to quote."""
    assert not blamed(error_of(plain, "launch"), str)
