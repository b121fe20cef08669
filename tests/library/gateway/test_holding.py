"""No two processes command one drone, wherever the folders of their journals are."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

from pluto_fleet.gateway.drone_lock import DroneInUse, lock_drones
from pluto_fleet.shared.domain.errors import BadInput

RADIO = "radio://0/80/2M/E7E7E7E7E7"


@pytest.mark.process
def test_a_second_process_is_refused_and_told_who_holds_the_drone(tmp_path: Path) -> None:
    """The first one's number is what it takes to end it."""
    said = "is commanded by process {} already"
    with _holder(tmp_path, RADIO) as first, pytest.raises(DroneInUse, match=said.format(first.pid)):
        _hold(tmp_path, cf1=RADIO)


@pytest.mark.parametrize(
    "other",
    [RADIO.lower(), "radio://1/80/2M/E7E7E7E7E7", f"{RADIO}?safelink=0", f" {RADIO}/"],
)
def test_one_drone_is_one_drone_however_its_uri_is_written(tmp_path: Path, other: str) -> None:
    """Another dongle reaches the very same drone."""
    with lock_drones({"cf1": RADIO}, tmp_path), pytest.raises(DroneInUse):
        _hold(tmp_path, cf2=other)


@pytest.mark.parametrize("other", ["radio://0/80/2M/E7E7E7E7E8", "udp://127.0.0.1:19850"])
def test_other_drones_are_free(tmp_path: Path, other: str) -> None:
    """A lock is one drone's, not one dongle's."""
    with lock_drones({"cf1": RADIO}, tmp_path):
        _hold(tmp_path, cf2=other)


def test_who_gets_one_drone_of_two_holds_neither(tmp_path: Path) -> None:
    """A gateway that may not begin keeps nothing from others."""
    with lock_drones({"cf2": "udp://b"}, tmp_path), pytest.raises(DroneInUse, match="cf2"):
        _hold(tmp_path, cf1="udp://a", cf2="udp://b")
    _hold(tmp_path, cf1="udp://a", cf2="udp://b")


def test_two_drones_of_one_fleet_cannot_be_the_same(tmp_path: Path) -> None:
    """That is a mistake in the fleet file, not another process."""
    with pytest.raises(BadInput, match="cf1 and cf2 have the same URI"):
        _hold(tmp_path, cf1=RADIO, cf2=RADIO.replace("//0", "//1"))


def test_the_locks_stand_in_the_users_runtime_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All processes of a user look there, and other users may not."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with lock_drones({"cf1": RADIO}):
        (folder,) = tmp_path.iterdir()
        assert folder.stat().st_mode & 0o077 == 0
        with pytest.raises(DroneInUse):
            _hold(None, cf1=RADIO)


def test_a_folder_that_others_may_enter_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Someone else could say there who commands what."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    folder = tmp_path / f"pluto-drones-{os.geteuid()}"
    folder.mkdir()
    folder.chmod(0o777)
    with pytest.raises(BadInput, match="no other user may enter it"):
        _hold(None, cf1=RADIO)


def _hold(folder: Path | None, **drones: str) -> None:
    with ExitStack() as stack:
        stack.enter_context(lock_drones(drones, folder))


def _holder(folder: Path, uri: str) -> subprocess.Popen[bytes]:
    """Return a process that has taken a drone's lock."""
    program = (
        "import sys, pathlib; from pluto_fleet.gateway.drone_lock import lock_drones\n"
        "with lock_drones({'cf1': sys.argv[1]}, pathlib.Path(sys.argv[2])):\n"
        "    print('taken', flush=True); sys.stdin.read()\n"
    )
    runtime = Path(sys.modules["plutoc_runtime"].__path__[0]).parent
    process = subprocess.Popen(
        [sys.executable, "-c", program, uri, str(folder)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(runtime)},
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"taken\n"
    return process
