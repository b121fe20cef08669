"""`plutoc new`, as a person calls it."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.cli.examples import names
from tests.compiler.cli.conftest import Call, tree
from tests.kit.apps import EXAMPLES, NAMES


def test_a_new_app_compiles_and_flies(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The commands that it prints are right."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(here.parent / "cache"))
    said = plutoc("new", "crop_watch")
    assert (said.code, said.err) == (0, "")
    assert "cd crop_watch" in said.out
    assert sorted(tree(here / "crop_watch")) == ["crop_watch.pluto", "fleet.toml", "missions.toml"]
    monkeypatch.chdir("crop_watch")
    commands = [
        line.partition("#")[0].split() for line in said.out.splitlines() if "  plutoc " in line
    ]
    assert [command[1] for command in commands] == ["check", "run", "compile"]
    for _, *arguments in commands:
        said = plutoc(*arguments)
        assert (said.code, said.err) == (0, "")


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("CropWatch", "write `crop_watch`"),
        ("json", "a module of Python's standard library"),
        ("nul", "a device on Windows"),
        ("distutils", "a module of Python's standard library"),
        ("asyncore", "a module of Python's standard library"),
        ("pip", "what builds or installs packages"),
        ("Pip_", "what builds or installs packages"),
        ("setuptools", "what builds or installs packages"),
        ("pkg__resources", "what builds or installs packages"),
        ("wheel", "what builds or installs packages"),
        ("sitecustomize", "what starts Python, or runs whenever it starts"),
        ("UserCustomize", "what starts Python, or runs whenever it starts"),
        ("python3", "what starts Python, or runs whenever it starts"),
        ("starlette_", "a package or folder that a generated app needs"),
        ("../up", "is not a name"),
        ("a b", "help: for instance `a_b`"),
        ("bl\u00fcten-suche", "help: for instance `bluten_suche`"),
        ("match", "a word of Python"),
        ("", "help: choose a plain name"),
        ("x" * 64, "63 are the most"),
    ],
)
def test_what_the_language_refuses_as_a_name_is_refused(
    plutoc: Call, here: Path, name: str, why: str
) -> None:
    """By the same rule, with the same words."""
    said = plutoc("new", name)
    assert said.code == 2
    assert why in said.err
    assert not list(here.iterdir())


def test_a_folder_with_something_in_it_is_refused(plutoc: Call, here: Path) -> None:
    """And what is no folder; an empty one will do."""
    Path("full").mkdir()
    Path("full/mine").touch()
    Path("file").touch()
    Path("link").symlink_to(here.parent)
    before = tree(here)
    for name, why in {"full": "is not empty", "file": "no folder", "link": "no folder"}.items():
        said = plutoc("new", name)
        assert said.code == 2
        assert why in said.err
    assert tree(here) == before
    Path("empty").mkdir()
    assert plutoc("new", "empty").code == 0


@pytest.mark.parametrize("example", NAMES)
def test_an_example_is_begun_with_under_another_name(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch, example: str
) -> None:
    """It checks, flies and compiles as the example does; only its app's name is another."""
    said = plutoc("new", "greenhouse", "--from", example)
    assert (said.code, said.err) == (0, "")
    assert ("its hooks" in said.out) == (EXAMPLES / example / "hooks.py").is_file()
    files = {path: text.decode() for path, text in tree(here / "greenhouse").items()}
    source = files.pop("greenhouse.pluto")
    assert source != (EXAMPLES / example / "app.pluto").read_text("utf-8")
    assert source.replace("app greenhouse ", f"app {example} ") == (
        EXAMPLES / example / "app.pluto"
    ).read_text("utf-8")
    assert files == {path: (EXAMPLES / example / path).read_text("utf-8") for path in files}
    monkeypatch.chdir("greenhouse")
    assert "no errors" in plutoc("check", "greenhouse.pluto").out
    assert plutoc("fmt", "--check", "greenhouse.pluto").code == 0
    flown = plutoc("run", "greenhouse.pluto")
    assert flown.code == 0, flown.out + flown.err
    assert plutoc("compile", "greenhouse.pluto").code == 0
    assert (here / "greenhouse/greenhouse/src/greenhouse/flow.py").is_file()


def test_the_examples_are_listed_with_their_titles(plutoc: Call) -> None:
    """No name is needed for that."""
    assert names() == NAMES
    said = plutoc("new", "--list")
    assert said.code == 0
    assert [line.split()[0] for line in said.out.splitlines()] == NAMES
    assert "alfalfa                   Alfalfa crop monitoring\n" in said.out


@pytest.mark.parametrize(
    ("example", "why"),
    [
        ("alfafa", "did you mean alfalfa?"),
        ("../alfalfa", "there is no example"),
        ("", "no example"),
    ],
)
def test_an_example_that_is_none_is_refused(
    plutoc: Call, here: Path, example: str, why: str
) -> None:
    """With what is meant, or with how to find it."""
    said = plutoc("new", "greenhouse", "--from", example)
    assert said.code == 2
    assert why in said.err and "`plutoc new --list` lists them" in said.err
    assert not list(here.iterdir())
