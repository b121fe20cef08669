"""`check` and `fmt` of folders, as a person calls them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call, tree

UNTIDY = APP.replace(" = ", "=")
MISTAKE = APP.replace("find_blooms)", "find_bloom)")


@pytest.fixture
def apps(here: Path) -> Path:
    """Apps in folders, and some where there is nothing to look for."""
    for name in ("b/deep/two", "b/one", "a", ".hidden/x", "venv/lib/x", "b/.git/x"):
        path = here / f"{name}.pluto"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(UNTIDY)
    (here / "venv/pyvenv.cfg").touch()
    (here / "b/folder.pluto").mkdir()
    (here / "b/notes.txt").write_text("no app")
    return here


def test_every_app_below_a_folder_is_checked(plutoc: Call, apps: Path) -> None:
    """Those in hidden folders and in virtual environments are not the developer's."""
    said = plutoc("check", ".")
    assert (said.code, said.err) == (0, "")
    found = [line.partition(":")[0] for line in said.out.splitlines()]
    assert found == ["a.pluto", "b/one.pluto", "b/deep/two.pluto"]
    (apps / "b/deep/two.pluto").write_text(MISTAKE)
    said = plutoc("check", ".")
    assert said.code == 1
    assert "--> b/deep/two.pluto:14:34" in said.err


def test_a_folder_that_is_named_is_always_looked_into(plutoc: Call, apps: Path) -> None:
    """Its name says that it is meant."""
    assert plutoc("check", ".hidden").out.startswith(".hidden/x.pluto: no errors")
    assert plutoc("check", "venv").out.startswith("venv/lib/x.pluto: no errors")


@pytest.mark.parametrize("command", ["check", "fmt"])
def test_a_file_that_is_named_twice_is_done_once(plutoc: Call, apps: Path, command: str) -> None:
    """By its name, by that of its folder, and by another way to write them."""
    said = plutoc(command, "b/one.pluto", "b", "./b", ".")
    found = [line.partition(":")[0] for line in said.out.splitlines()]
    assert found == ["b/one.pluto", "b/deep/two.pluto", "a.pluto"]


def test_every_app_below_a_folder_is_formatted(plutoc: Call, apps: Path) -> None:
    """And no other file is touched."""
    before = tree(apps)
    assert plutoc("fmt", "--check", "b").code == 1
    said = plutoc("fmt", "b")
    assert (said.code, said.err) == (0, "")
    assert said.out == "b/one.pluto: formatted\nb/deep/two.pluto: formatted\n"
    after = tree(apps)
    changed = {path for path in after if after[path] != before[path]}
    assert changed == {"b/one.pluto", "b/deep/two.pluto"}


@pytest.mark.parametrize("command", ["check", "fmt"])
def test_a_folder_without_an_app_ends_with_2(plutoc: Call, apps: Path, command: str) -> None:
    """What else is named is done all the same."""
    (apps / "empty/.hidden").mkdir(parents=True)
    (apps / "empty/.hidden/x.pluto").write_text(APP)
    said = plutoc(command, "empty", "a.pluto")
    assert said.code == 2
    assert said.err == ("plutoc: the folder empty holds no app, no file that ends with .pluto\n")
    assert said.out.startswith("a.pluto: ")


def test_programs_are_told_of_an_empty_folder_too(plutoc: Call, here: Path) -> None:
    """As they are of a file that is not there."""
    said = plutoc("check", ".", "--format", "github")
    assert said.code == 2
    assert said.out.startswith("::error") and "the folder . holds no app" in said.out


def test_links_in_a_folder_are_passed_over(plutoc: Call, apps: Path) -> None:
    """Neither is a file elsewhere formatted, nor is one gone round in a ring."""
    (apps / "b/ring").symlink_to(apps / "b")
    (apps / "b/link.pluto").symlink_to(apps / "a.pluto")
    assert plutoc("fmt", "b").out == "b/one.pluto: formatted\nb/deep/two.pluto: formatted\n"
    assert (apps / "a.pluto").read_text() == UNTIDY
    assert plutoc("fmt", "b/link.pluto").out == "b/link.pluto: formatted\n"


@pytest.mark.skipif(os.name != "posix", reason="only there a mode keeps readers out")
def test_a_folder_that_cannot_be_read_is_told(
    plutoc: Call, apps: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The others are looked into."""
    scandir = os.scandir

    def refusing(path: str | os.PathLike[str]) -> object:
        if os.fspath(path).endswith("deep"):
            raise PermissionError(13, "Permission denied", os.fspath(path))
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refusing)  # root may read everything
    said = plutoc("check", "b")
    assert said.code == 2
    assert said.err == "plutoc: the folder b/deep cannot be read: Permission denied\n"
    assert said.out.startswith("b/one.pluto: no errors")
    said = plutoc("check", "b/deep")
    assert said.err == "plutoc: the folder b/deep cannot be read: Permission denied\n"
