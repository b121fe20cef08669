"""Many apps to generate packages of: examples, and all that blocks can have."""

from __future__ import annotations

from large_apps import app
from plutoc.compile import analyse, package_of
from plutoc.source import Source
from tests.compiler.emit.apps import ODD_NAMES, PARCELS, PLAIN
from tests.paths import ROOT

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


def modules_of(text: str) -> dict[str, str]:
    """Return the Python modules of an app's package but for the runtime's, as Black wrote them."""
    checked, _ = analyse(Source("app.pluto", text))
    package = package_of(checked, source_name="app.pluto")
    return {
        path: text.replace("# fmt: off\n", "", 1)
        for path, text in {**package.owned, **package.once}.items()
        if path.endswith(".py") and "/_runtime/" not in path
    }
