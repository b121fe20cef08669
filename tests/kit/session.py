"""Sessions: commands as a person types them, and what they print, in text files beside the tests.

A folder holds sessions, `NAME.txt`, and the files that each of their scenes begins with. A scene is a
sentence and what is typed after it; it has a new folder of its own:

    # A mistake is told with its place.

    $ sed s/find_blooms)/find_bloom)/ crop.pluto
    < a line that is given as standard input
    $ plutoc check crop.pluto
    | a line on standard output
    ! a line on standard error
    = 1

`= 1` is the exit code, where it is not 0. Programs are called in this process; `$ FORCE_COLOR=1 plutoc ...`,
`> FILE`, `< FILE`, `2>&1` and `| grep TEXT` do what a shell does by them, and so do the commands in `BUILT_IN`
of `tests/kit/shell.py`. `pytest FOLDER --update` writes what comes out as what must come out: read the difference.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from plutoc import __version__
from tests.kit.command import Program, Ran
from tests.kit.shell import Shell

Mask = Callable[[str], str]
"""Replaces in what is printed what is another at each run."""


def sessions(folder: Path) -> list[Any]:
    """Return the sessions of a folder and of those in it, to parametrize a test with.

    The marks of one are named in brackets at the end of its first line: `[process, long]`.
    """
    found = []
    for path in sorted(folder.rglob("*.txt")):
        title = path.read_text("utf-8").partition("\n")[0]
        named = re.search(r"\[([a-z, ]+)\]$", title)
        marks = [getattr(pytest.mark, name) for name in named[1].split(", ")] if named else []
        name = str(path.relative_to(folder).with_suffix(""))
        found.append(pytest.param(path, id=name, marks=marks))
    assert found, folder
    return found


def check_session(
    path: Path, programs: Mapping[str, Program], update: bool, tmp_path: Path, mask: Mask = str
) -> None:
    """Type what is in a session, and compare what comes out."""
    written = path.read_text(encoding="utf-8")
    lines: list[str] = []
    for number, scene in enumerate(_scenes(written)):
        here = tmp_path / str(number) / "work"
        shutil.copytree(path.parent, here, ignore=shutil.ignore_patterns(path.name, "*.txt"))
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(here)
            lines += _played(scene, Shell(programs, here, patch), mask)
    came = "\n".join(lines) + "\n"
    if update and came != written:
        path.write_text(came, encoding="utf-8")
        written = came
    assert came == written


def _scenes(text: str) -> Iterator[list[str]]:
    """Split a session before each sentence that follows a command."""
    scene: list[str] = []
    for line in text.splitlines():
        if line.startswith("# ") and any(one.startswith("$ ") for one in scene):
            yield scene
            scene = []
        scene.append(line)
    yield scene


def _played(scene: list[str], shell: Shell, mask: Mask) -> Iterator[str]:
    """Yield the lines of a scene with what comes out of its commands now."""
    kept = [line for line in scene if line[:1] not in ("|", "!", "=")]
    for number, line in enumerate(kept):
        if line[:1] != "<":
            yield line
        if line.startswith("$ "):
            given: list[str] = []
            for after in kept[number + 1 :]:
                if after[:1] != "<":
                    break
                given.append(after)
                yield after
            text = "".join(f"{each[2:]}\n" for each in given)
            yield from _shown(shell.typed(line[2:], text), lambda out: mask(_same(out, shell.here)))


def _shown(ran: Ran, mask: Mask) -> Iterator[str]:
    """Yield what a command printed, and its exit code, as a session has it."""
    for mark, text in (("|", ran.out), ("!", ran.err)):
        for line in mask(text).splitlines():
            yield f"{mark} {line}".rstrip()
    if ran.code:
        yield f"= {ran.code}"


_USAGE = re.compile(r"^usage: .*\n( +.*\n)*(?=\S)", re.MULTILINE)
_CHOICES = re.compile(r"\(choose from .*?\)")
"""What argparse words otherwise in other versions of Python."""


def _same(text: str, here: Path) -> str:
    """Leave out of a text which folder and which versions these are; show what commands a terminal."""
    text = _CHOICES.sub("(choose from …)", _USAGE.sub("usage: …\n", text))
    text = text.replace(str(here), "HERE").replace(__version__, "VERSION")
    return re.sub(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", lambda found: repr(found[0])[1:-1], text)
