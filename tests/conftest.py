"""What all tests share."""

from __future__ import annotations

import asyncio
import signal
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.apart import apart
from tests.loops import run_async

pytest_plugins = ("tests.kit.browser", "tests.kit.station")

# The same examples in every run, however busy the machine is: a test that fails is a change's fault.
settings.register_profile(
    "pluto", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("pluto")

# A shell that runs this in the background may make it, and all that it starts, deaf to these.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep nothing in the user's own cache, and take nothing from there."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(autouse=True, scope="session")
def own_locks() -> Iterator[None]:
    """Take no drone's lock that other tests on this machine take, those of another checkout."""
    with apart():
        yield


_STARTS = ("subprocess.Popen", "os.fork", "os.forkpty", "os.posix_spawn")
"""What the interpreter calls the start of a process."""
_running: list[pytest.Item] = []
"""The test that runs, if processes are no matter of course for it."""


def _refuse_processes(event: str, _: tuple[object, ...]) -> None:
    if _running and event in _STARTS:
        raise AssertionError(
            f"{_running[0].nodeid} starts a process: mark it `process`, `browser` or `long`"
        )


sys.addaudithook(_refuse_processes)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Hold that only those tests start a process that say so: few do, in the default run."""
    if not any(map(item.get_closest_marker, ("process", "browser", "long"))):
        _running.append(item)
    try:
        return (yield)
    finally:
        _running.clear()


def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run an async test."""
    return run_async(pyfuncitem, asyncio.run)


_NEVER_ALONE = (
    *("equivalence", "fuzz", "hostile", "kill", "soundness", "trials"),
    "test_mutations.py",
)
"""Shares of campaigns. Of 338 bugs that were planted (`python -m tests.planted`) none was caught by these alone."""
_LONG = (*_NEVER_ALONE, "release")
"""Rooms that the default run leaves out: in the last each test waits for pip or for a wheel."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave some rooms out of the default run, and begin with what takes long in one piece.

    At the end, all workers but one would wait for that.
    """
    here = Path(__file__).parent
    for item in items:
        if any(here / name in (item.path, *item.path.parents) for name in _LONG):
            item.add_marker(pytest.mark.long)
    items.sort(key=lambda item: item.get_closest_marker("first") is None)


def pytest_addoption(parser: pytest.Parser) -> None:
    """`pytest --update` writes what comes out as what must come out."""
    parser.addoption(
        "--update", action="store_true", help="rewrite the expected output of tests/cases"
    )


@pytest.fixture
def update(request: pytest.FixtureRequest) -> bool:
    """Whether expected output is to be rewritten."""
    return bool(request.config.getoption("--update"))
