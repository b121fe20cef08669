"""`pluto-fleet`, the library's own program: what it says, and that nothing makes it end with a traceback."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import pluto_fleet
from pluto_fleet import api, extras
from pluto_fleet.__main__ import main
from pluto_fleet.shared.domain.app import SEAM

PROJECT = Path(pluto_fleet.__path__[0]).parent / "pyproject.toml"
APPS = "an app is flown by its own program, such as: greenhouse fly missions.toml"
BY_ITSELF = "an app starts this by itself when it flies; there is nothing to do by hand"


def test_the_version_names_library_seams_and_extras(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    out, err = capsys.readouterr()
    first, second = out.splitlines()
    assert first == f"pluto-fleet {pluto_fleet.__version__}, speaks seam {SEAM}"
    assert second == f"extras: {extras.installed()}"
    assert err == ""


def test_each_extra_is_installed_or_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """One of which a part is missing is not installed."""
    monkeypatch.setattr(extras, "version", lambda name: "1.2")
    there = {"cflib", "mcap", "PIL", "starlette", "uvicorn", "websockets", "matplotlib", "shapely"}
    monkeypatch.setattr(extras, "find_spec", lambda name: name if name in there else None)
    there |= {"mavsdk", "pymavlink"}
    assert extras.installed() == (
        "areas (shapely 1.2), crazyflie (cflib 1.2), mavlink (mavsdk 1.2, pymavlink 1.2),"
        " plot (matplotlib 1.2),"
        " station (mcap 1.2, pillow 1.2, starlette 1.2, uvicorn 1.2, websockets 1.2)"
    )
    there -= {"cflib", "uvicorn", "shapely", "mavsdk"}
    assert extras.installed() == (
        "plot (matplotlib 1.2); not installed: areas, crazyflie, mavlink, station"
    )
    there.clear()
    assert extras.installed() == "not installed: areas, crazyflie, mavlink, plot, station"


def test_the_extras_are_those_that_an_installer_knows() -> None:
    with PROJECT.open("rb") as file:
        project = tomllib.load(file)["project"]
    brought = {
        extra: tuple(one.partition(">=")[0] for one in packages)
        for extra, packages in project["optional-dependencies"].items()
    }
    assert brought == extras.EXTRAS
    assert project["scripts"] == {"pluto-fleet": "pluto_fleet.__main__:main"}


def test_the_help_says_how_an_app_is_flown(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    assert APPS in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("", "the following arguments are required: COMMAND"),
        ("fly missions.toml", f'pluto-fleet: there is no command "fly"; {APPS}'),
        ("--versions", "the following arguments are required: COMMAND"),
        ("--version=1", "ignored explicit argument '1'"),
        ("gateway", f"gateway: {BY_ITSELF}"),
        ("gateway --help", f"gateway: {BY_ITSELF}"),
        ("gateway /no/such/folder", f"gateway: {BY_ITSELF}"),
        ("gateway . .", f"gateway: {BY_ITSELF}"),
        ("crtp", f"crtp: {BY_ITSELF}"),
        ("crtp /no/such/folder", f"crtp: {BY_ITSELF}"),
    ],
)
def test_a_command_line_that_is_wrong_is_told_so(
    words: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.rstrip("\n").endswith(said)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"drones": [1]}', "{", '{"airspace": null}'])
def test_settings_that_are_none_are_told_so(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A gateway that cannot start ends with its own code, which an app that has started it knows."""
    file = tmp_path / "settings.json"
    file.write_text(text, encoding="utf-8")
    assert main(["gateway", str(tmp_path)]) == 4
    assert capsys.readouterr().err.startswith(f"{file}: these are no settings of a gateway: ")


@pytest.mark.long
@pytest.mark.process
def test_output_that_cannot_be_written_ends_cleanly() -> None:
    command = [sys.executable, "-m", "pluto_fleet", "--version"]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    said = "pluto-fleet: the output cannot be written: No space left on device\n"
    assert (done.returncode, done.stderr) == (2, said)


@pytest.mark.parametrize("package", ["no_such_app", "json"])
def test_what_is_no_app_is_refused(package: str) -> None:
    with pytest.raises(api.BadInput, match=f"^{package} is no app that can be imported here: "):
        api.load_app(package)
