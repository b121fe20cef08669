"""What sessions are typed into: programs of this process, and some of what a shell has."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

from plutoc import __version__
from tests.kit.command import Program, Ran, run

_ESCAPE = re.compile(r"\\u([0-9a-f]{4})")
"""A character that a session cannot show."""


_ESCAPED = re.compile(r"\\[nt]")


def _white(found: re.Match[str]) -> str:
    return {"\\n": "\n", "\\t": "\t"}[found[0]]


def _character(found: re.Match[str]) -> str:
    return chr(int(found[1], 16))


class Shell:
    """Runs lines in the current folder, which is a scene's own.

    The exit code of commands between `|` is the first one that is not 0.
    """

    def __init__(
        self, programs: Mapping[str, Program], here: Path, patch: pytest.MonkeyPatch
    ) -> None:
        self.here = here
        self._programs = programs
        self._patch = patch

    def typed(self, line: str, given: str = "") -> Ran:
        """Run a line: commands between `|`, with `< FILE` and `> FILE`."""
        words = [
            _ESCAPE.sub(_character, word)
            for word in shlex.split(line.replace("VERSION", __version__))
        ]
        *first, last = _split(words, "|")
        code, err = 0, ""
        for words in first:
            ran = self._command(words, given)
            code, given, err = code or ran.code, ran.out, err + ran.err
        ran = self._command(last, given)
        return Ran(code or ran.code, ran.out, err + ran.err)

    def _command(self, words: Sequence[str], text: str) -> Ran:
        words, source = _without(words, "<")
        words, target = _without(words, ">")
        both = "2>&1" in words
        words = [word for word in words if word != "2>&1"]
        given = text.encode() if source is None else Path(source).read_bytes()
        env: dict[str, str] = {}
        while words[0].partition("=")[0].isupper():
            variable, _, value = words.pop(0).partition("=")
            env[variable] = value
        name, *rest = words
        if name == "cd":
            self._patch.chdir(rest[0])
            return Ran(0, "", "")
        if name in self._programs:
            ran = run(self._programs[name], *rest, given=given, env=env)
        else:
            ran = Ran(0, BUILT_IN[name](rest, given.decode()) or "", "")
        if both:
            ran = Ran(ran.code, ran.out + ran.err, "")
        if target is not None:
            Path(target).write_bytes(ran.out.encode())
            ran = ran._replace(out="")
        return ran


def _split(words: Sequence[str], mark: str) -> list[list[str]]:
    parts: list[list[str]] = [[]]
    for word in words:
        if word == mark:
            parts.append([])
        else:
            parts[-1].append(word)
    return parts


def _without(words: Sequence[str], mark: str) -> tuple[list[str], str | None]:
    """Take `< FILE` or `> FILE` out of a command."""
    if mark not in words:
        return list(words), None
    at = words.index(mark)
    return [*words[:at], *words[at + 2 :]], words[at + 1]


def _cat(words: Sequence[str], given: str) -> str:
    return "".join(Path(word).read_bytes().decode("utf-8-sig") for word in words) or given


def _sed(words: Sequence[str], _: str) -> None:
    """`sed s/OLD/NEW/ FILE...`: replace a text, which must be there, in files.

    It is no pattern; the character after the s is what stands between, and `\\n` is a new line.
    """
    script, *files = words
    _, old, new, _ = (_ESCAPED.sub(_white, part) for part in script.split(script[1]))
    for file in files:
        text = Path(file).read_text("utf-8")
        assert old in text, f"{file} has no {old!r}"
        Path(file).write_text(text.replace(old, new), "utf-8")


def _rm(words: Sequence[str], _: str) -> None:
    for word in words:
        path = Path(word)
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink()


def _mkdir(words: Sequence[str], _: str) -> None:
    for word in words:
        Path(word).mkdir(parents=True)


def _ls(words: Sequence[str], _: str) -> str:
    """`ls [FOLDER]`: everything in it, but what Python compiled."""
    folder = Path(*words)
    found = sorted(folder.rglob("*"))
    shown = [path for path in found if "__pycache__" not in path.parts]
    return "".join(f"{path.relative_to(folder)}{'/' * path.is_dir()}\n" for path in shown)


def _echo(words: Sequence[str], _: str) -> str:
    return " ".join(words).encode("latin-1", "backslashreplace").decode("unicode-escape") + "\n"


def _latin(words: Sequence[str], _: str) -> None:
    """`latin FILE`: an app that is not in UTF-8."""
    Path(words[0]).write_bytes(b"pluto 1\n# caf\xe9\n")


def _large(words: Sequence[str], _: str) -> None:
    """`large FILE`: an app that is larger than one may be."""
    Path(words[0]).write_bytes(b"#" * ((1 << 20) + 1))


def _touch(words: Sequence[str], _: str) -> None:
    for word in words:
        Path(word).touch()


def _link(words: Sequence[str], _: str) -> None:
    """`ln TARGET LINK`: a symbolic link."""
    Path(words[1]).symlink_to(words[0])


def _copy(words: Sequence[str], _: str) -> None:
    shutil.copy(words[0], words[1])


def _move(words: Sequence[str], _: str) -> None:
    Path(words[0]).rename(words[1])


def _chmod(words: Sequence[str], _: str) -> None:
    Path(words[1]).chmod(int(words[0], 8))


def _grep(words: Sequence[str], given: str) -> str:
    """`| grep [-v] TEXT`: the lines with, or without, a text, which is no pattern."""
    wanted = words[0] != "-v"
    lines = given.splitlines(keepends=True)
    return "".join(line for line in lines if (words[-1] in line) is wanted)


def _compare(words: Sequence[str], _: str) -> str:
    """`cmp FILE FILE`: whether they are the same, also when they are folders."""
    one, other = (_tree(Path(word)) for word in words)
    different = sorted(str(path) for path in {*one, *other} if one.get(path) != other.get(path))
    return "".join(f"{path} differs\n" for path in different)


def _tree(path: Path) -> dict[Path, bytes]:
    files = [path] if path.is_file() else [each for each in path.rglob("*") if each.is_file()]
    return {each.relative_to(path): each.read_bytes() for each in files}


def _head(words: Sequence[str], given: str) -> str:
    """`| head N`: so many lines, or with a negative number so many from the end."""
    lines = given.splitlines(keepends=True)
    number = int(words[0])
    return "".join(lines[:number] if number > 0 else lines[number:])


def _wc(_: Sequence[str], given: str) -> str:
    return f"{len(given.splitlines())} lines\n"


BUILT_IN: dict[str, Callable[[Sequence[str], str], str | None]] = {
    "cat": _cat,
    "chmod": _chmod,
    "cmp": _compare,
    "cp": _copy,
    "echo": _echo,
    "grep": _grep,
    "head": _head,
    "large": _large,
    "latin": _latin,
    "ln": _link,
    "ls": _ls,
    "mkdir": _mkdir,
    "mv": _move,
    "rm": _rm,
    "sed": _sed,
    "touch": _touch,
    "wc": _wc,
}
