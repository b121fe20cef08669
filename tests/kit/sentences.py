"""Files with mistakes and what must be said of each, as text beside the tests.

An entry is the text of a file, and then the lines that must be said of it, each after `-> `; of an entry of
which nothing may be said, there is a bare `->`. `pytest FOLDER --update` rewrites what must be said.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

MARK = "->"


def entries(path: Path) -> list[tuple[str, list[str]]]:
    """Return the texts of a list with what is said of each."""
    found: list[tuple[str, list[str]]] = []
    text: list[str] = []
    said: list[str] = []
    for line in [*path.read_text("utf-8").splitlines(), ""]:
        if line.startswith(MARK):
            said.append(line[len(MARK) + 1 :])
            continue
        if said:
            found.append(("".join(text).lstrip("\n"), said))
            text, said = [], []
        text.append(f"{line}\n")
    return found


def check_sentences(path: Path, say: Callable[[str], Sequence[str]], update: bool) -> None:
    """Compare what is said of each text with what must be said of it."""
    written = entries(path)
    came = [(text, list(say(text)) or [""]) for text, _ in written]
    if update:
        blocks = (
            text + "".join(f"{MARK} {line}".rstrip() + "\n" for line in said) for text, said in came
        )
        path.write_text("\n".join(blocks), encoding="utf-8")
        written = entries(path)
    assert came == written
