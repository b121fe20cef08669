"""The parser, made of the grammar once and kept in the user's own cache folder."""

from __future__ import annotations

import os
import stat
import sys
from functools import cache
from importlib.resources import files
from pathlib import Path

import lark

from plutoc.syntax.newlines import Newlines


@cache
def parser() -> lark.Lark:
    """Return the parser of the language."""
    grammar = files("plutoc_grammar").joinpath("pluto.lark").read_text(encoding="utf-8")
    folder = _cache_folder()
    python = ".".join(map(str, sys.version_info[:2]))
    return lark.Lark(
        grammar,
        start="file",
        parser="lalr",
        lexer="basic",
        postlex=Newlines(),
        propagate_positions=True,
        maybe_placeholders=True,
        # Lark checks by hash that what it finds there was made of this grammar and this Lark.
        cache=str(folder / f"grammar-lark{lark.__version__}-py{python}") if folder else False,
    )


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
        if os.name == "posix" and (facts.st_uid != os.getuid() or facts.st_mode & 0o022):
            return None
    except (OSError, RuntimeError):  # RuntimeError: there is no home folder
        return None
    return folder
