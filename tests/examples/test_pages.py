"""Pictures and quoted files in the pages are current."""

from __future__ import annotations

import importlib.util
import re
import shlex
from pathlib import Path
from types import ModuleType

import pytest

from pluto_fleet.cli.options import parse
from plutoc.cli import main
from tests.library.files.an_app import APP
from tests.paths import ROOT


def script() -> ModuleType:
    """Return `docs/tutorial/make_pictures.py`, which is a script and in no package."""
    path = ROOT / "docs" / "tutorial" / "make_pictures.py"
    spec = importlib.util.spec_from_file_location("make_pictures", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


MAKE = script()


@pytest.mark.parametrize("page", MAKE.pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_page_is_current(page: Path) -> None:
    """`python docs/tutorial/make_pictures.py` would change nothing."""
    text = page.read_text(encoding="utf-8")
    assert MAKE.refreshed(text, page.parent) == text


@pytest.mark.parametrize(
    "page", sorted(ROOT.glob("examples/*/README.md")), ids=lambda p: p.parts[-2]
)
def test_readme_of_an_example_shows_its_graph(
    page: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The picture is what `plutoc graph` prints."""
    assert main(["graph", str(page.parent / "app.pluto")]) == 0
    assert f"```mermaid\n{capsys.readouterr().out}```\n" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize("page", MAKE.pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    """What a page refers to in the repository is there."""
    text = re.sub(
        r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL
    )
    for link in re.findall(r"\]\(([^)#\s]+)", text):
        assert "://" in link or (page.parent / link).exists(), link


APPS = ["my_app", *(path.name for path in sorted(ROOT.glob("examples/*/")))]
TYPED = [
    (file, command)
    for file in sorted([*ROOT.glob("docs/tutorial/*.md"), *ROOT.glob("examples/*/README.md")])
    for app, command in re.findall(r"^\$ (\w+) (.*)$", file.read_text("utf-8"), re.MULTILINE)
    if app in APPS
]
SAID = [f"{file.relative_to(ROOT)}: {command}" for file, command in TYPED]


@pytest.mark.parametrize(("file", "command"), TYPED, ids=SAID)
def test_command_of_a_page_is_one_of_the_app(file: Path, command: str) -> None:
    """The app takes what a reader is told to type, and the files that it names are there."""
    assert parse(APP, shlex.split(command)).command
    folder = file.parent if file.name == "README.md" else ROOT / "examples/drugs_distribution"
    if folder.name == "tutorial":
        folder = ROOT / "plutoc/cli/starter"
    for name in re.findall(r"\b\w+\.toml\b", command):
        assert (folder / name).exists(), name


def test_every_example_says_how_it_is_served() -> None:
    """With the extra that this needs, under the app's own name; areas need a package more."""
    for page in ROOT.glob("examples/*/README.md"):
        name, text = page.parts[-2], page.read_text(encoding="utf-8")
        areas = (
            ' "shapely>=2"'
            if "mission.area" in (page.with_name("missions.toml")).read_text()
            else ""
        )
        wanted = f'$ pip install -e "./{name}[station]"{areas}\n$ {name} serve --sim'
        assert wanted in text, name
