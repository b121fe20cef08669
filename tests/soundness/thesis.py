"""The graphs of the thesis: our examples, and what else it draws."""

from __future__ import annotations

from pathlib import Path

from tests.paths import EXAMPLES
from tests.soundness.app import App, read

HERE = Path(__file__).parent


def thesis_graphs() -> dict[str, App]:
    """Return them by name, always in the same order."""
    examples = sorted(EXAMPLES.glob("*/app.pluto"))
    drawn = sorted((HERE / "graphs").glob("*.pluto"))
    return {
        **{path.parent.name: read(path.read_text(encoding="utf-8")) for path in examples},
        **{path.stem: read(path.read_text(encoding="utf-8")) for path in drawn},
    }
