"""Texts that were made before are not made again, and come out the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.emit import python, render
from plutoc.emit.memory import SHELF, edition
from plutoc.emit.project_files import Entry
from plutoc.emit.python import formatted

TEXT = "x  =  {'a': 1}\n"
WANTED = 'x = {"a": 1}\n'


@pytest.fixture(autouse=True)
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "pluto" / SHELF


def test_a_text_is_formatted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """After that, Black is not asked."""
    assert formatted(TEXT) == WANTED
    monkeypatch.setattr(python, "_formatted", pytest.fail)
    assert formatted(TEXT) == WANTED


def test_a_template_is_rendered_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """After that, Jinja2 is not asked, until the template changes or what is put into it."""
    first = render.render("main.py", Entry(app="crop"))
    with monkeypatch.context() as patch:
        patch.setattr(render, "_rendered", pytest.fail)
        assert render.render("main.py", Entry(app="crop")) == first
    assert render.render("main.py", Entry(app="corn")) == first.replace("crop", "corn")
    monkeypatch.setattr(render, "_templates", lambda: {"main.py.jinja": "{{ app }}!"})
    render._environment.cache_clear()
    assert render.render("main.py", Entry(app="crop")) == "crop!"
    render._environment.cache_clear()


def test_a_text_in_another_state_than_it_was_kept_in_is_not_used(shelf: Path) -> None:
    """No file is ever made of it."""
    formatted(TEXT)
    (file,) = shelf.iterdir()
    file.write_bytes(file.read_bytes().replace(b"x = ", b"y = "))
    assert formatted(TEXT) == WANTED


def test_another_release_of_black_is_asked_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """It may write otherwise."""
    formatted(TEXT)
    monkeypatch.setattr(python, "edition", lambda package: "another")
    monkeypatch.setattr(python, "_formatted", lambda text: "as another writes\n")
    assert formatted(TEXT) == "as another writes\n"


def test_the_edition_of_a_package_tells_its_release_without_importing_it() -> None:
    """It is in the name of the folder that pip puts beside it."""
    from importlib.metadata import version

    assert f"black-{version('black')}.dist-info" in edition("black").split("\n")
    assert edition("no_such_package") == ""
