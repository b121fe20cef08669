"""The parser, made of the grammar once and kept in the user's own cache folder."""

from __future__ import annotations

import os
import stat
import sys
from contextlib import suppress
from functools import cache
from importlib.resources import files
from pathlib import Path

import lark

from plutoc.syntax.newlines import Newlines


@cache
def parser() -> lark.Lark:
    """Return the parser of the language."""
    grammar = files("plutoc_grammar").joinpath("pluto.lark").read_text(encoding="utf-8")
    kept = _cache_file()
    made = lark.Lark(
        grammar,
        start="file",
        parser="lalr",
        lexer="basic",
        postlex=Newlines(),
        propagate_positions=True,
        maybe_placeholders=True,
        # Lark checks by hash that what it finds there was made of this grammar and this Lark.
        cache=str(kept) if kept else False,
    )
    if kept:
        with suppress(OSError):  # Lark writes it as writable as any other file of the user's
            kept.chmod(0o600)
    return made


def _cache_file() -> Path | None:
    """Return where the parser is kept, or None where that would not be safe.

    It gets unpickled, which can run code: one that others could have written is taken away first.
    """
    folder = _cache_folder()
    if folder is None:
        return None
    python = ".".join(map(str, sys.version_info[:2]))
    file = folder / f"grammar-lark{lark.__version__}-py{python}"
    try:
        facts = file.lstat()
        if not stat.S_ISREG(facts.st_mode) or _is_others(facts):
            file.unlink()
    except FileNotFoundError:
        pass
    except OSError:
        return None
    return file


def _cache_folder() -> Path | None:
    """Return our cache folder, or None where it would not be safe or cannot be written.

    What is in it gets unpickled, which can run code: nobody else may be able to write it.
    """
    try:
        root = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(root) if os.path.isabs(root) else Path.home() / ".cache"
        folder = base / "pluto"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        facts = folder.lstat()
        if not stat.S_ISDIR(facts.st_mode) or not os.access(folder, os.W_OK):
            return None
        if _is_others(facts):
            return None
    except (OSError, RuntimeError):  # RuntimeError: there is no home folder
        return None
    return folder


def _is_others(facts: os.stat_result) -> bool:
    """Say whether somebody else can write there."""
    return os.name == "posix" and (facts.st_uid != os.getuid() or bool(facts.st_mode & 0o022))
