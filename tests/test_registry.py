"""The blocks that are installed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from plutoc import registry
from plutoc.registry import RegistryError

Install = Callable[[str, str, str], None]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Install:
    """Install a package of one module that declares blocks."""
    monkeypatch.syspath_prepend(str(tmp_path))
    registry.blocks_of.cache_clear()

    def install(name: str, module: str, code: str) -> None:
        (tmp_path / f"{module}.py").write_text(code)
        facts = tmp_path / f"{module}-1.dist-info"
        facts.mkdir()
        (facts / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1\n")
        (facts / "entry_points.txt").write_text(f"[plutoc.blocks]\n{name} = {module}:BLOCKS\n")

    return install


GOOD = """
from plutoc.block import ANY_SAME, Block
BLOCKS = (Block(name="Scan", doc="Scans.", step=print, transitions=ANY_SAME),)
"""


def test_ours_are_there_without_an_installation() -> None:
    """A checkout compiles."""
    assert registry.installed_packages()[0] == "std"
    assert len(registry.blocks_of("std")) == 15


def test_package_is_found_by_its_entry_point(install: Install) -> None:
    """Under the name of its entry point, its blocks under their kinds."""
    install("good_one", "good_one_module", GOOD)
    assert "good_one" in registry.installed_packages()
    assert list(registry.blocks_of("good_one")) == ["Scan"]
    assert list(registry.installed()["good_one"]) == ["Scan"]


@pytest.mark.parametrize(
    ("code", "sentence"),
    [
        ("import a_module_that_is_not_there", "cannot be loaded"),
        ("raise RuntimeError('out of tune')", "RuntimeError: out of tune"),
        ("", "cannot be loaded"),
        ("raise SystemExit(0)", "SystemExit: 0"),
        ("BLOCKS = 3", "is of type int, not a tuple of blocks"),
        ("BLOCKS = ('Scan',)", "of type str, not only blocks"),
        (GOOD + "BLOCKS *= 2", "declares Scan twice"),
        (GOOD.replace("doc=", "holds=True, doc="), "holds missions back .* named=True"),
        (GOOD.replace("doc=", "allocates=True, doc="), "gives missions their drones .* named=True"),
    ],
)
def test_broken_package_is_told_when_used(install: Install, code: str, sentence: str) -> None:
    """Naming it is harmless; using it says what is wrong with it."""
    module = f"broken_module_{len(code)}"
    install("broken_one", module, code)
    assert "broken_one" in registry.blocks().packages
    with pytest.raises(RegistryError, match=sentence):
        registry.blocks_of("broken_one")


def test_two_packages_of_one_name(install: Install) -> None:
    """Which one is meant cannot be known."""
    install("same_name", "same_name_one", GOOD)
    install("same_name", "same_name_two", GOOD)
    with pytest.raises(RegistryError, match="two installed packages"):
        registry.blocks_of("same_name")


def test_unknown_package() -> None:
    """It is not installed."""
    with pytest.raises(RegistryError, match="no package of blocks named nowhere"):
        registry.blocks_of("nowhere")
