"""The texts of many packages before they are formatted: examples, and all that blocks can have."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from large_apps import app
from plutoc.compile import analyse, package_of
from plutoc.emit import canonical, python
from plutoc.emit.canonical import shapes_of
from plutoc.source import Source
from tests.emit.apps import ODD_NAMES, PARCELS, PLAIN

ROOT = Path(__file__).parents[2]
LARGE = {"chain": 60, "wide": 40, "forks": 160}
"""Blocks: so many that a flow becomes one `match`, or that a comment takes more than a line."""
APPS = [
    *(path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("examples/*/app.pluto"))),
    *(
        path.read_text(encoding="utf-8")
        for path in sorted(ROOT.glob("tests/cases/alfalfa/*.pluto"))
    ),
    *(path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("benchmarks/*/*.pluto"))),
    *(app(shape, size) for shape, size in LARGE.items()),
    PLAIN,
    ODD_NAMES,
    PARCELS,
]


@cache
def texts() -> tuple[str, ...]:
    """Return what is formatted to make the packages of all apps, plain and optimised."""
    found: dict[str, None] = {}

    def asked(text: str) -> str:
        found[text] = None
        return text

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("plutoc.emit.python.formatted", asked)
        patch.setattr("plutoc.emit.hooks_file.formatted", asked)
        for text in APPS:
            checked, _ = analyse(Source("app.pluto", text))
            for optimise in (True, False):
                package_of(checked, source_name="app.pluto", optimise=optimise)
    return tuple(found)


@cache
def written() -> tuple[str, ...]:
    """Return the same texts as Black writes them."""
    return tuple(python.black_asked(text) for text in texts())


def learned() -> Iterator[str]:
    """Yield every shape in them: what `canonical.txt` is to hold."""
    yield from sorted({shape for text in written() for shape in shapes_of(text)})


def file_of(shapes: Iterator[str]) -> str:
    """Return the text of `canonical.txt`."""
    return "".join(f"{shape}\n" for shape in shapes)


KNOWN = canonical.KNOWN
