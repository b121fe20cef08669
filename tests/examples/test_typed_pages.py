"""What a new reader types works as it stands there, and shows what the page shows."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from plutoc.cli import main
from tests.examples.typed import Reader, is_ended, is_shown, only_read, steps
from tests.paths import ROOT

TUTORIAL = [ROOT / "docs/tutorial/README.md", ROOT / "docs/tutorial/exercise.md"]
PAGES = [*TUTORIAL, ROOT / "docs/sizing.md"]
README = (ROOT / "README.md").read_text("utf-8")


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("file", PAGES, ids=lambda file: file.stem)
def test_what_a_page_has_one_type_shows_what_it_shows(
    file: Path, tmp_path: Path, update: bool
) -> None:
    """From nothing to a flown mission, a stopped flight and its resumption; in order, in one folder."""
    folder = tmp_path / "anywhere"
    folder.mkdir()
    shutil.copytree(ROOT / "examples", folder / "examples")
    reader = Reader(folder, tmp_path / "programs")
    text = file.read_text("utf-8")
    found = list(steps(text))
    assert len(found) >= 5
    for step in found:
        code, came = reader.type(step)
        if update and step.shown and not is_ended(step.shown):
            text = text.replace(f"$ {step.command}\n{step.shown}\n", f"$ {step.command}\n{came}\n")
        elif step.shown:
            assert is_shown(step.shown, came), f"{step.command}: this came:\n{came}"
        else:
            assert code == 0, f"{step.command}: {came}"
    if update:
        file.write_text(text, "utf-8")


@pytest.mark.parametrize("file", TUTORIAL, ids=lambda file: file.stem)
def test_the_tutorial_says_what_needs_more_than_a_computer(file: Path) -> None:
    """What is not typed by the test above is not passed over in silence."""
    text = file.read_text("utf-8")
    found = list(only_read(text))
    assert found
    for needs, words in found:
        assert needs.removeprefix("a ") in words


@pytest.mark.long
@pytest.mark.process
def test_a_reader_of_the_readme_can_type_it_all_in_an_empty_folder(tmp_path: Path) -> None:
    """One session, as it stands there; it ends at the first command that does not work."""
    before, browser, radio = _of_the_readme("greenhouse ")
    assert "plutoc new greenhouse" in before and "resume" in before
    folder = tmp_path / "empty"
    folder.mkdir()
    reader = Reader(folder, tmp_path / "programs")
    done = subprocess.run(
        ["bash", "-e", "-o", "pipefail"],
        input=before,
        cwd=folder,
        env=reader.environment,
        capture_output=True,
        text=True,
        check=False,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "warning" not in said
    assert re.search(r"\d drones? crashed\)$", said, re.MULTILINE), "the mishaps are to be seen"
    assert "max_attempts" in said, "an edit is told in words"
    for block, word in ((radio, "Crazyradio"), (browser, "browser")):
        assert word in _words_before(block), word
    assert "--sim" not in radio and "serve" in browser


def test_the_readmes_first_command_greets_without_a_warning(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A person who sees Pluto for the first time has done nothing wrong yet."""
    (app,) = re.findall(r"plutoc run (examples/\S+\.pluto)", README)
    assert main(["check", str(ROOT / app)]) == 0
    assert "warning" not in capsys.readouterr().err


def test_the_readme_counts_its_lines_of_pluto() -> None:
    """As a reader does who learns that there are so few."""
    (source,) = re.findall(r"^```\n(pluto 1\n.*?)^```$", README, re.MULTILINE | re.DOTALL)
    words = ["Ten", "Eleven", "Twelve", "Thirteen", "Fourteen", "Fifteen"]
    count = sum(bool(line.strip()) for line in source.splitlines())
    assert f"{words[count - 10]} lines of Pluto" in README


def _of_the_readme(word: str) -> list[str]:
    """Return the blocks of a section of commands."""
    blocks = re.findall(r"^```\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)
    return [block for block in blocks if word in block]


def _words_before(block: str) -> str:
    return README[: README.index(block)].rpartition("\n```\n")[0].rpartition("```")[2]
