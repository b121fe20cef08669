"""The pages: a fixed table of files, read once. No path is ever made of a request."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path

FOLDER = Path(__file__).parent / "pages"
PAGE = "index.html"

_NAME = re.compile(r"[a-z0-9][a-z0-9_.-]*")
_KINDS = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class StaticFile:
    """One file, and what a browser knows it by."""

    type: str
    content: bytes
    mark: str


@cache
def pages(folder: Path = FOLDER) -> Mapping[str, StaticFile]:
    """Return the files by their addresses, such as `style/shell.css`."""
    table = {}
    for file in sorted(folder.rglob("*")):
        parts = file.relative_to(folder).parts
        kind = _KINDS.get(file.suffix)
        if kind is not None and all(map(_NAME.fullmatch, parts)) and file.is_file():
            content = file.read_bytes()
            mark = f'"{sha256(content).hexdigest()[:24]}"'
            table["/".join(parts)] = StaticFile(type=kind, content=content, mark=mark)
    return table
