"""The runtime's tests run twice: in place, and on a copy embedded in a package.

`tests/test_embedded_runtime.py` runs them again with PLUTO_EMBEDDED naming a folder that holds a
package `carrier` with a `_runtime`; then every import of the runtime or of a block's step gets the
embedded module instead.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING

import pytest

from tests.forks import recorded
from tests.one_brain import Elsewhere
from tests.paths import EXAMPLES

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from tests.flying import Example

EMBEDDED = os.environ.get("PLUTO_EMBEDDED")
HOME = "carrier._runtime"


def embedded_name(name: str) -> str | None:
    """Return where an embedded copy has this module of the brain, or block's step; None: it is neither."""
    for brain in ("pluto_fleet.shared", "plutoc_runtime"):
        if f"{name}.".startswith(f"{brain}."):
            return f"{HOME}{name.removeprefix(brain)}"
    if name.startswith("plutoc_blocks.") and name.endswith(".step"):
        return f"{HOME}.blocks.{name.split('.')[1]}"
    return None


if EMBEDDED:
    assert not [name for name in sys.modules if embedded_name(name)], "loaded before the copy"
    sys.path.insert(0, EMBEDDED)
    sys.meta_path.insert(0, Elsewhere(embedded_name))


@pytest.fixture
def no_worker_left(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Hold that each process that a test forks has ended, and was waited for; others may have children here."""
    forked = recorded(monkeypatch)
    yield
    assert forked, "nothing was forked"
    for child in forked:
        with pytest.raises(ChildProcessError):
            os.waitpid(child, os.WNOHANG)


@pytest.fixture(
    scope="session", params=sorted(path.parent.name for path in EXAMPLES.glob("*/app.pluto"))
)
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Example:
    """Return an example, compiled and imported."""
    from tests.flying import built

    return built(request.param, tmp_path_factory.mktemp("examples"))


@pytest.fixture
def example_app(example: Example) -> App:
    """Return its app."""
    from pluto_fleet.app import described

    app: App = described(import_module(f"{example.name}.flow").APP)
    return app
