"""Flying Crazyflies comes with a package's extra, and everything else without."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

from tests.release.environments import ROOT, compile_app, fresh, run, succeed

EXAMPLE = ROOT / "examples/drugs_distribution"
MISSIONS, FLEET = EXAMPLE / "missions.toml", EXAMPLE / "fleet.toml"


def test_without_the_extra_fly_says_what_to_install(tmp_path: Path) -> None:
    """Nothing has begun then; and what needs no radio works."""
    package = compile_app(EXAMPLE / "app.pluto", tmp_path / "package")
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", package, ROOT / "runtime")
    program = programs / "drugs_distribution"
    succeed(program, "simulate", MISSIONS, "--fleet", FLEET)
    for words in (["fly", str(MISSIONS)], ["drones"]):
        done = run(program, *words, "--fleet", FLEET, XDG_STATE_HOME=str(tmp_path / "state"))
        assert (done.code, done.out) == (2, "")
        assert "pip install 'drugs_distribution[crazyflie]'" in done.err
    assert not (tmp_path / "state").exists()


def test_the_extra_names_the_version_that_the_tests_fly_with() -> None:
    """The one that was read and measured, and its mends; another minor version may do otherwise."""
    for file in ("plutoc/emit/templates/pyproject.toml.jinja", "runtime/pyproject.toml"):
        assert 'crazyflie = ["cflib>=0.1.34,<0.2"]' in (ROOT / file).read_text(encoding="utf-8")
    major, minor, *mend = map(int, version("cflib").split(".")[:3])
    assert (major, minor) == (0, 1)
    assert mend >= [34]
