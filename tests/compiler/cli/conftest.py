"""An app in a folder of its own, and the command line as a person would call it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from plutoc import registry
from plutoc.cli import main
from plutoc.emit import modules

APP = """pluto 1

app crop "Crop watch" {
  category scout can take_photo, pollinate

  action pollinate(dose: mass = 50 mg)
  evaluator find_blooms

  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 3)
  judge = MissionEvaluator(hook: find_blooms)

  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  watch -> judge when COMPLETED
  retry -> allocate when STANDBY
  judge -> allocate when STANDBY
  judge -> end otherwise
  retry -> end otherwise
}
"""

FIELD_APP = APP.replace("pluto 1\n", "pluto 1\nuse field_kit\n").replace(
    "  start -> create -> allocate",
    "  chime = field_kit.Chime\n  start -> create -> chime -> allocate",
)
"""With a block of a package that `installed` pretends to be."""

MISSIONS = """
[[mission]]
name = "North"
  [[mission.trip]]
  action = "take_photo"
  target = [2, 3]
"""


@dataclass(frozen=True, slots=True)
class Said:
    """What a command ended with, and what it printed."""

    code: int
    out: str
    err: str


Call = Callable[..., Said]


@pytest.fixture
def plutoc(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    """Call the command line in this process."""
    for name in ("NO_COLOR", "FORCE_COLOR", "PLUTO_DEBUG"):
        monkeypatch.delenv(name, raising=False)

    def call(*arguments: str | Path) -> Said:
        capfd.readouterr()
        code = main([str(argument) for argument in arguments])
        return Said(code, *capfd.readouterr())

    return call


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, and we are in it."""
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def app(here: Path) -> Path:
    """An app with two hooks and a missions file, in a folder that we are in."""
    (here / "crop.pluto").write_text(APP)
    (here / "missions.toml").write_text(MISSIONS)
    return Path("crop.pluto")


def tree(folder: Path) -> dict[str, bytes]:
    """Return every file below a folder; links and folders by their kind."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else b"a folder"
        for path in sorted(folder.rglob("*"))
        if "__pycache__" not in path.parts
    }


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder on Python's path, with the metadata of a package of blocks in it."""
    folder = tmp_path / "site-packages"
    facts = folder / "field_kit-1.dist-info"
    facts.mkdir(parents=True)
    (facts / "METADATA").write_text("Metadata-Version: 2.1\nName: field_kit\nVersion: 1\n")
    (facts / "entry_points.txt").write_text("[plutoc.blocks]\nfield_kit = field_kit:BLOCKS\n")
    monkeypatch.syspath_prepend(folder)
    registry.blocks_of.cache_clear()
    modules.load.cache_clear()
    yield folder
    registry.blocks_of.cache_clear()
    modules.load.cache_clear()
    for name in [name for name in sys.modules if name.partition(".")[0] == "field_kit"]:
        del sys.modules[name]


def declare(installed: Path, step: str) -> None:
    """Let that package have the block `Chime`, whose step is in a module of its own."""
    package = installed / "field_kit"
    package.mkdir()
    (package / "step.py").write_text(step)
    (package / "__init__.py").write_text(
        "from plutoc.block import ANY_SAME, Block\nfrom .step import chime\n"
        'BLOCKS = [Block(name="Chime", doc="Chimes.", step=chime, transitions=ANY_SAME)]\n'
    )
