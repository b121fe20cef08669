"""The ground station, and flying Crazyflies, come with a package's extras, and everything else without."""

from __future__ import annotations

import json
import signal
import subprocess
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.request import Request, urlopen

import pytest

from tests.release.environments import ROOT, compile_app, fresh, run, succeed

EXAMPLE = ROOT / "examples/drugs_distribution"
MISSIONS, FLEET = EXAMPLE / "missions.toml", EXAMPLE / "fleet.toml"
PAGES = ROOT / "runtime/pluto_fleet/station/pages"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a generated package."""
    return compile_app(EXAMPLE / "app.pluto", tmp_path_factory.mktemp("made") / "package")


def files(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.long  # pip installs into a fresh environment, as in test_packages_install.py
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


@pytest.mark.long  # pip installs into a fresh environment, as in test_packages_install.py
def test_with_the_extra_it_serves_the_app_that_was_compiled(package: Path, tmp_path: Path) -> None:
    """With the graph of its README, though no file of the package holds that."""
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", ROOT / "runtime", f"{package}[station]")
    program = programs / "drugs_distribution"
    words = ["serve", "--sim", "--port", "0", "--folder", str(tmp_path), "--fleet", str(FLEET)]
    with subprocess.Popen([str(program), *words], stdout=subprocess.PIPE, text=True) as serving:
        try:
            assert serving.stdout is not None
            address = serving.stdout.readline().removeprefix("station: ").strip()
            app = asked(f"{address}api/app")
            assert [block["name"] for block in app["graph"]["blocks"]] == [
                *("start", "create", "allocate", "launch", "watch", "end")
            ]
            with urlopen(address) as page:
                assert page.read() == (PAGES / "index.html").read_bytes()
        finally:
            serving.send_signal(signal.SIGINT)
            serving.wait(timeout=30)


def test_the_extra_names_the_version_that_the_tests_fly_with() -> None:
    """The one that was read and measured, and its mends; another minor version may do otherwise."""
    for file in ("plutoc/emit/templates/pyproject.toml.jinja", "runtime/pyproject.toml"):
        assert 'crazyflie = ["cflib>=0.1.34,<0.2"]' in (ROOT / file).read_text(encoding="utf-8")
    major, minor, *mend = map(int, version("cflib").split(".")[:3])
    assert (major, minor) == (0, 1)
    assert mend >= [34]


def asked(address: str) -> Any:
    """Return what the station answers."""
    with urlopen(Request(address, headers={"X-Pluto": "1"})) as answer:
        return json.load(answer)
