"""An app in a folder of its own, and a package of blocks that is not there."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc import registry
from plutoc.emit import modules

CROP = Path(__file__).parent / "sessions" / "crop"
"""An app with two hooks, and its missions."""

APP = (CROP / "crop.pluto").read_text("utf-8")

FIELD_APP = APP.replace("pluto 1\n", "pluto 1\nuse field_kit\n").replace(
    "  start -> create -> allocate",
    "  chime = field_kit.Chime\n  start -> create -> chime -> allocate",
)
"""With a block of a package that `installed` pretends to be."""


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
    for name in ("crop.pluto", "missions.toml"):
        shutil.copy(CROP / name, here)
    return Path("crop.pluto")


FOLDER = b"a folder"


def tree(folder: Path) -> dict[str, bytes]:
    """Return every file below a folder; links and folders by their kind."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else FOLDER
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
