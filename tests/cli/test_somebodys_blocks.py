"""An app with a block of somebody else's that cannot be copied into its package."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc import registry
from plutoc.emit import modules
from tests.cli.conftest import APP, Call, tree

FIELD_APP = APP.replace("pluto 1\n", "pluto 1\nuse field_kit\n").replace(
    "  start -> create -> allocate",
    "  chime = field_kit.Chime\n  start -> create -> chime -> allocate",
)
DECLARATION = """
from plutoc.block import ANY_SAME, Block
{step}
BLOCKS = [Block(name="Chime", doc="Chimes.", step=chime, transitions=ANY_SAME)]
"""


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


def test_a_block_that_cannot_be_carried_along_ends_with_1(
    plutoc: Call, app: Path, here: Path, installed: Path
) -> None:
    """The report says where in that package, and what to change. Nothing is written."""
    module = installed / "field_kit.py"
    module.write_text(DECLARATION.format(step="def chime(run, status): return status"))
    app.write_text(FIELD_APP)
    before = tree(here)
    assert plutoc("check", app).code == 0
    said = plutoc("compile", app)
    assert said.code == 1
    assert "[P4009]: the package cannot carry this app's blocks along" in said.err
    assert f"{module}:2: plutoc.block is neither of the standard library" in said.err
    assert tree(here) == before
