"""What the compiler says about a stranger's source commands neither a terminal nor a build."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP
from tests.fuzz.texts import HOSTILE
from tests.kit.command import plutoc

WRONG = APP.replace("max_attempts: 3", 'max_attempts: "{}"').replace("Crop watch", "{}")
NAMES = [
    "a%0A::error::b",
    "::error::b",
    "a,line=9",
    "a:b",
    "\x1b[31m",
    "\x07",
    "\N{RIGHT-TO-LEFT OVERRIDE}",
]


def write(name: str, text: str) -> Path:
    """Write an app with a mistake beside which a text is shown, in a folder of an odd name."""
    folder = Path(name)
    folder.mkdir(exist_ok=True)
    path = folder / "crop.pluto"
    path.write_text(WRONG.replace("{}", text))
    return path


def every(texts: list[str]) -> list[Path]:
    """Write an app for each text, and one in each odd folder."""
    paths = [write(f"folder_{i}", text) for i, text in enumerate(texts)]
    return paths + [write(name, "plain") for name in NAMES]


TEXTS = [text for text in HOSTILE if "\n" not in text]


def test_a_build_gets_no_command_but_ours(here: Path) -> None:
    """Each line is one of a finding, with its own file, and holds nothing that begins another."""
    paths = every(TEXTS)
    done = plutoc("check", *paths, "--format", "github")
    assert done.code == 1
    lines = done.out.splitlines()
    assert len(lines) >= len(paths)
    for line in lines:
        assert line.startswith(("::error file=", "::warning file=")), line
        assert line.isprintable(), ascii(line)
        properties = line.split("::")[1].split(" ", 1)[1]
        keys = [one.partition("=")[0] for one in properties.split(",")]
        assert len(keys) == len(set(keys))
        assert set(keys) <= {"file", "line", "endLine", "col", "endColumn", "title"}
        assert "\r" not in line


@pytest.mark.parametrize("format", ["text", "json", "sarif"])
def test_a_terminal_gets_nothing_that_acts(here: Path, format: str) -> None:
    """No escape sequence and nothing that reorders a line; JSON stays JSON."""
    done = plutoc("check", *every(TEXTS), "--format", format)
    assert done.code == 1
    assert all(char == "\n" or char.isprintable() for char in done.err), ascii(done.err)
    if format == "json":
        for line in done.out.splitlines():
            assert json.loads(line)["severity"]
        assert done.out.isascii()
    elif format == "sarif":
        assert json.loads(done.out)["version"] == "2.1.0"


@pytest.mark.parametrize("name", [*NAMES, "a\n::error::b"])
def test_a_folder_with_an_odd_name_is_compiled_in_peace(here: Path, name: str) -> None:
    """Its name comes into what a person is told to type, too."""
    Path(name).mkdir()
    (Path(name) / "crop.pluto").write_text(APP)
    for _ in range(2):
        done = plutoc("compile", Path(name) / "crop.pluto")
        assert (done.code, done.err) == (0, "")
        assert all(line.isprintable() for line in done.out.split("\n")), ascii(done.out)
        assert not any(line.lstrip().startswith("::") for line in done.out.splitlines()[1:])
        (Path(name) / "crop.pluto").write_text(APP.replace("Crop watch", "Another title"))
