"""Today's library flies packages of each seam that it speaks, and those from before there was a library."""

from __future__ import annotations

import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from pluto_fleet.seam import NEWEST, written
from tests.kit.apps import compiled, compiled_file, fly_straight
from tests.seam.packages import (
    BEFORE,
    HERE,
    KEPT,
    NAME,
    SEAMS,
    SOURCES,
    WITH_HOOKS,
    Kept,
    begun,
    environment,
    imported,
    plan,
    said,
    unpacked,
)

ENDED = [
    pytest.param(seam, end, id=f"{seam}-{said_so}")
    for seam in (SEAMS[0], SEAMS[-1])
    for end, said_so in ((signal.SIGINT, "stopped"), (signal.SIGKILL, "killed"))
]
"""How flights end, of the oldest seam and the newest: those between are flown and simulated."""

POURS = "pours on"
"""What the action of the app with hooks says, in the middle of a flight."""


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of that package."""
    return unpacked(Kept(BEFORE, NAME), tmp_path_factory.mktemp("before"))


@pytest.mark.long  # nothing of it changes but Python
def test_a_package_from_before_still_flies_alone(before: Path, tmp_path: Path) -> None:
    """It has all that it needs, and takes nothing of the library that is beside it now."""
    journal = str(tmp_path / "flight.journal")
    flight = ("fly", *plan(NAME, HERE / BEFORE), "--sim", "--speed", "200", "--journal", journal)
    flown = said(before, *flight)
    assert flown.returncode == 0, flown.stderr
    assert "missions completed" in flown.stdout.splitlines()[-1]
    code = f"import sys, {NAME}.flow, {NAME}._runtime.cli.simulate; print(*sys.modules)"
    modules = subprocess.run(
        [sys.executable, "-c", code],
        env=environment(before),
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert f"{NAME}._runtime.session" in modules
    assert "pluto_fleet" not in modules


@pytest.mark.long  # a whole flight; of newer seams it is always seen
def test_a_journal_from_before_is_gone_on_from(before: Path, tmp_path: Path) -> None:
    """That package's flight is stopped in the middle; the same app, compiled today, flies the rest."""
    journal = tmp_path / "flight.journal"
    with begun(before, journal, home=HERE / BEFORE) as flying:
        flying.send_signal(signal.SIGINT)
    resumed = said(compiled(NAME, tmp_path), "resume", str(journal))
    assert resumed.returncode == 0, resumed.stderr
    assert "missions completed" in resumed.stdout.splitlines()[-1]


def test_packages_of_every_seam_are_kept() -> None:
    """Todays too: tomorrow they are old ones. One of them has a hook of each kind."""
    assert written(NEWEST) in SEAMS
    assert [Kept(seam, name) for seam in SEAMS for name in sorted(SOURCES)] == KEPT


@pytest.mark.parametrize("kept", KEPT, ids=str)
def test_it_is_flown(kept: Kept, tmp_path: Path) -> None:
    """And the library imports nothing of it but its brain, from the first instant to the last."""
    package = unpacked(kept, tmp_path)
    assert f"seam {kept.seam}," in said(package, "--version").stdout
    assert said(package, "simulate", *plan(kept.name)).returncode == 0
    journal = str(tmp_path / "flight.journal")
    flight = ("fly", *plan(kept.name), "--sim", "--speed", "200", "--journal", journal)
    flown = said(package, *flight)
    assert flown.returncode == 0, flown.stderr
    assert (POURS in flown.stdout) == (kept.name == WITH_HOOKS)
    assert imported(package) >= only_the_brain(kept.name)
    if kept.seam == written(NEWEST):
        assert imported(package) == only_the_brain(kept.name)


def only_the_brain(name: str) -> set[str]:
    """Return all that the library may import of an app, and where it does."""
    return {f"pluto_fleet.app {name}._runtime.brain"}


def test_it_is_tried(tmp_path: Path) -> None:
    """By `plutoc test`, which kills it at every instant."""
    package = unpacked(Kept(written(NEWEST), NAME), tmp_path)
    tried = subprocess.run(
        [sys.executable, "-m", "pluto_fleet.trials", NAME, "--seeds", "1"],
        env=environment(package),
        capture_output=True,
        text=True,
        check=False,
    )
    assert tried.returncode == 0, tried.stderr + tried.stdout
    assert imported(package) == only_the_brain(NAME)


@pytest.mark.parametrize("kept", KEPT, ids=str)
def test_it_simulates_as_if_it_were_compiled_today(kept: Kept, tmp_path: Path) -> None:
    """Event by event, also where flights go wrong: a package changes only when it is compiled.

    Where legs are straight: a brain of an earlier seam sees them so in any case.
    """
    then = unpacked(kept, tmp_path / "then")
    now = compiled_file(SOURCES[kept.name] / "app.pluto", tmp_path / "now" / kept.name)
    missions, flag, fleet = plan(kept.name)
    fly_straight(straight := Path(shutil.copy(fleet, tmp_path)))
    files = (missions, flag, str(straight))
    wrong = ("--seed", "3", "--fail", "crash=5%,link=20%,action=10%")
    told = []
    for package in (then, now):
        trace = tmp_path / f"{package.parent.name}.trace"
        done = said(package, "simulate", *files, *wrong, "--trace", str(trace))
        assert done.returncode in (0, 1), done.stderr
        told.append((done.returncode, done.stdout, trace.read_text(encoding="utf-8")))
    assert told[0] == told[1]


@pytest.mark.parametrize(("seam", "end"), ENDED)
def test_it_is_resumed(seam: str, end: signal.Signals, tmp_path: Path) -> None:
    package, journal = unpacked(Kept(seam, NAME), tmp_path), tmp_path / "flight.journal"
    with begun(package, journal) as flying:
        flying.send_signal(end)
    resumed = said(package, "resume", str(journal))
    assert resumed.returncode == 0, resumed.stderr
    assert "missions completed" in resumed.stdout.splitlines()[-1]
    if seam == written(NEWEST):
        assert imported(package) == only_the_brain(NAME)


@pytest.mark.parametrize(
    "compiled_anew",
    [False, pytest.param(True, marks=pytest.mark.long)],  # whole flights once more
    ids=["as_it_is", "compiled_anew"],
)
@pytest.mark.parametrize(("seam", "end"), ENDED)
def test_an_action_that_was_cut_short_is_decided_on(
    seam: str, end: signal.Signals, compiled_anew: bool, tmp_path: Path
) -> None:
    """Water is not poured twice by itself: a person says that none was, and the rest is flown.

    By the package that began, or by the same app of today.
    """
    package = unpacked(Kept(seam, WITH_HOOKS), tmp_path)
    journal = str(tmp_path / "flight.journal")
    with begun(package, Path(journal), POURS) as flying:
        flying.send_signal(end)
    if compiled_anew:
        package = compiled_file(SOURCES[WITH_HOOKS] / "app.pluto", tmp_path / "now" / WITH_HOOKS)
    asked = said(package, "resume", journal)
    assert asked.returncode == 4, asked.stderr
    (answer,) = [line for line in asked.stdout.splitlines() if line.endswith(" not-done")]
    _, *words = shlex.split(answer)
    decided = said(package, *words)
    assert decided.returncode == 0, decided.stderr
    resumed = said(package, "resume", journal)
    assert resumed.returncode == 0, resumed.stderr
    assert "2 of 2 missions completed" in resumed.stdout.splitlines()[-1]
    assert "COMPLETED" in said(package, "journal", journal).stdout
