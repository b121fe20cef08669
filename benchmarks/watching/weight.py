"""What the pages weigh that an installed library serves: each file gzipped by itself."""

from __future__ import annotations

import gzip
import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from pluto_fleet.station.web.static import pages

Weights = dict[str, int]

_IMPORTS = re.compile(r'(?:from|import)\s*"(\.{1,2}/[^"]+)"')
_PAGE = re.compile(r"/pages/(\w+)/page\.js")
"""What main.js loads when the head is there."""
_ON_DEMAND = re.compile(r"/pages/(texts/(?!en\.)|icon-|index\.html)")
"""Other languages, icons of an installed program, and what is served at / already."""


def kilobytes(library: Path) -> dict[str, float]:
    """Return what each page adds to the head, which comes first and has all styles; and all together."""
    files = pages(library / "pluto_fleet" / "station" / "pages")
    weights = {name: len(gzip.compress(file.plain, mtime=0)) for name, file in files.items()}
    texts = {name: file.plain.decode() for name, file in files.items() if name.endswith("js")}
    opened = {page[1]: _needed(name, texts) for name in texts if (page := _PAGE.fullmatch(name))}
    everything = {name for name in weights if not _ON_DEMAND.match(name)}
    head = _needed("/pages/main.js", texts)
    head |= everything.difference(head, *opened.values())
    told = {"weight of the head of all pages, gzipped, kB": head}
    told |= {f"weight of the page {page} beside it, kB": own - head for page, own in opened.items()}
    told["weight of all pages, gzipped, kB"] = everything
    return {what: sum(weights[name] for name in names) / 1000 for what, names in told.items()}


def _needed(module: str, texts: Mapping[str, str]) -> set[str]:
    """Return a module with all that it imports when it is loaded."""
    found, left = set[str](), [module]
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            left += [_at(name, path) for path in _IMPORTS.findall(texts[name])]
    return found


def _at(module: str, path: str) -> str:
    """Return the address of what a module imports by a relative path."""
    parts = list[str]()
    for part in (PurePosixPath(module).parent / path).parts:
        if part == "..":
            parts.pop()
        else:
            parts.append(part)
    return str(PurePosixPath(*parts))
