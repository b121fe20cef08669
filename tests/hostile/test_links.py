"""Nothing is written or read through a link, and nothing outside of the package's folder changes."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from plutoc.emit.errors import Place
from plutoc.emit.lock import lock
from plutoc.emit.package import Package
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.source import Source, Span
from tests.compiler.cli.conftest import APP, tree
from tests.kit.command import plutoc

SECRET = "-----BEGIN PRIVATE KEY-----\nxyzzy = (\n"
PLACE = Place(source=Source("a.pluto", "app a {}"), span=Span(4, 5))


@pytest.fixture
def outside(here: Path) -> Path:
    """A folder beside ours with something secret in it."""
    folder = here.parent / "outside"
    folder.mkdir()
    (folder / "secret").write_text(SECRET)
    return folder


FOLDERS = ("crop", "crop/src/crop", "crop/src/crop/_runtime/blocks", "crop/tests")
FILES = ("src/crop/flow.py", "src/crop/hooks.py", "tests/test_hooks.py", "pluto.lock", "README.md")
LINKED = [*FOLDERS, *(f"crop/{name}" for name in FILES)]


@pytest.mark.parametrize("path", LINKED)
@pytest.mark.parametrize(
    ("target", "force"), [("outside", ["--force"]), ("moved", []), ("nowhere", ["--force"])]
)
def test_no_link_is_written_through(
    app: Path, outside: Path, path: str, target: str, force: list[str]
) -> None:
    """Not to a folder, not to a file, not to what is not there yet; not by `--force` either."""
    plutoc("compile", app)
    place = Path(path)
    moved = outside / "moved"
    shutil.move(place, moved)
    is_folder = moved.is_dir()
    to = {"outside": outside if is_folder else outside / "secret", "moved": moved}
    place.symlink_to(to.get(target, outside / "nowhere"))
    (app).write_text(APP.replace("Crop watch", "Another title"))
    before = tree(outside)
    done = plutoc("compile", app, *force)
    assert tree(outside) == before
    assert "BEGIN PRIVATE" not in done.out + done.err
    if place.name in ("hooks.py", "test_hooks.py") and target != "nowhere":
        return  # theirs: it is not written in any case
    assert done.code == 3, done
    assert place.is_symlink()


def test_no_link_to_a_secret_is_read(app: Path, outside: Path) -> None:
    """Neither shown in a message nor taken along into a package."""
    Path("hooks.py").symlink_to(outside / "secret")
    for command in ("check", "compile", "run"):
        done = plutoc(command, app)
        assert done.code in (1, 3)
        assert "is a symbolic link" in done.err
        assert "xyzzy" not in done.out + done.err
    assert not Path("crop").exists()


def test_add_stubs_writes_through_no_link(app: Path, outside: Path) -> None:
    """The developer's own file may be one, and is still not ours to follow."""
    plutoc("compile", app)
    hooks = Path("crop/src/crop/hooks.py")
    hooks.unlink()
    (outside / "hooks.py").write_text("")
    hooks.symlink_to(outside / "hooks.py")
    assert plutoc("compile", app, "--add-stubs").code == 3
    assert (outside / "hooks.py").read_text() == ""


@pytest.mark.parametrize("name", ["..", ".", "/", "../..", "outside/../../outside"])
def test_a_folder_with_other_things_in_it_stays_as_it_is(
    app: Path, outside: Path, name: str
) -> None:
    """`-o` may name any folder, but only an empty or new one, or a package of ours, is written."""
    before = tree(app.absolute().parent.parent)
    done = plutoc("compile", app, "-o", name, "--force")
    assert done.code in (2, 3)
    assert tree(app.absolute().parent.parent) == before


def test_a_damaged_record_leads_to_no_other_file(app: Path, outside: Path) -> None:
    """A stranger's pluto.lock may name any path: none outside is removed."""
    plutoc("compile", app)
    record = Path("crop/pluto.lock")
    text = record.read_text()
    for path in ("../../outside/secret", str(outside / "secret"), "src/../../../outside/secret"):
        record.write_text(f'{text}"{path}" = "{"0" * 64}"\n')
        assert plutoc("compile", app).code == 3
        plutoc("compile", app, "--force")
        assert (outside / "secret").read_text() == SECRET


def package(texts: dict[str, str]) -> Package:
    """Return a package of these files."""
    return Package(name="a", owned={**texts, "pluto.lock": lock("a", "a", [], texts)}, once={})


@pytest.mark.parametrize("swapped", ["src", "src/a", "src/a/flow.py", ""])
def test_a_link_that_is_swapped_in_stops_the_writing(tmp_path: Path, swapped: str) -> None:
    """Between looking and writing an attacker puts a link to another folder where one of ours was."""
    folder, outside = tmp_path / "a", tmp_path / "outside"
    write(compare(package({"src/a/flow.py": "old\n", "README.md": "old\n"}), folder, PLACE))
    changes = compare(package({"src/a/flow.py": "new\n", "README.md": "new\n"}), folder, PLACE)
    place = folder / swapped
    place.rename(outside)
    place.symlink_to(outside)
    before = tree(outside)
    with pytest.raises(CannotWrite, match="was put there meanwhile"):
        write(changes)
    assert tree(outside) == before
    assert not [name for name in os.listdir(tmp_path) if name.startswith(".plutoc")]


def test_a_hard_link_is_parted_and_not_written_through(app: Path) -> None:
    """A file of ours that is another one, too: new text goes into a new file."""
    plutoc("compile", app)
    os.link("crop/README.md", "other.md")
    before = Path("other.md").read_text()
    app.write_text(APP.replace("Crop watch", "Another title"))
    assert plutoc("compile", app).code == 0
    assert Path("other.md").read_text() == before
    assert "Another title" in Path("crop/README.md").read_text()


def test_a_pipe_or_a_folder_in_the_way_is_refused(app: Path) -> None:
    """Nothing waits for it."""
    plutoc("compile", app)
    for make in (os.mkfifo, os.mkdir):
        for path in ("crop/README.md", "crop/src/crop/hooks.py", "crop/src/crop/flow.py"):
            aside = Path("aside")
            shutil.move(path, aside)
            make(path)
            assert plutoc("compile", app, "--force").code == 3
            os.remove(path) if make is os.mkfifo else os.rmdir(path)
            shutil.move(aside, path)
    assert plutoc("compile", app).code == 0
