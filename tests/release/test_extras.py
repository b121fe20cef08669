"""The ground station, and flying Crazyflies, come with a package's extras, and everything else without."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

import pytest

from tests.paths import ROOT
from tests.release.environments import compile_app, fresh, run, succeed

EXAMPLE = ROOT / "examples/drugs_distribution"
MISSIONS, FLEET = EXAMPLE / "missions.toml", EXAMPLE / "fleet.toml"
PAGES = ROOT / "runtime/pluto_fleet/station/pages"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a generated package."""
    return compile_app(EXAMPLE / "app.pluto", tmp_path_factory.mktemp("made") / "package")


def files(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_without_the_extras_it_is_said_what_to_install(package: Path, tmp_path: Path) -> None:
    """Nothing has begun then. All else works; and every page is there already."""
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", package, ROOT / "runtime")
    program = programs / "drugs_distribution"
    assert "--port" in succeed(program, "serve", "--help")
    succeed(program, "simulate", MISSIONS, "--fleet", FLEET)
    for install, words in (
        ("drugs_distribution[station]", ["serve", "--sim", "--folder", str(tmp_path / "kept")]),
        ("pluto-fleet[crazyflie]", ["fly", str(MISSIONS)]),
        ("pluto-fleet[crazyflie]", ["drones"]),
    ):
        done = run(program, *words, "--fleet", FLEET, XDG_STATE_HOME=str(tmp_path / "state"))
        assert (done.code, done.out) == (2, "")
        assert f"pip install '{install}'" in done.err
    assert not (tmp_path / "state").exists()
    assert not (tmp_path / "kept").exists()

    (pages,) = (tmp_path / "venv").rglob("pluto_fleet/station/pages")
    assert files(pages) == files(PAGES)


def test_the_extra_names_the_version_that_the_tests_fly_with() -> None:
    """The one that was read and measured, and its mends; another minor version may do otherwise."""
    for file in ("plutoc/emit/templates/pyproject.toml.jinja", "runtime/pyproject.toml"):
        assert 'crazyflie = ["cflib>=0.1.34,<0.2"]' in (ROOT / file).read_text(encoding="utf-8")
    major, minor, *mend = map(int, version("cflib").split(".")[:3])
    assert (major, minor) == (0, 1)
    assert mend >= [34]
