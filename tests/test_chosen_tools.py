"""Each of the tools that the project chose really does its work in a compile, by its public functions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import black
import jinja2
import lark
import networkx as nx
import pytest

from cold_start import SOUND
from plutoc.cli import main

CHOSEN: dict[str, tuple[object, str]] = {
    "Lark: tokens": (lark.Lark, "lex"),
    "Lark: parser": (lark.Lark, "parse_interactive"),
    "networkx: reachability": (nx, "bfs_layers"),
    "networkx: components": (nx, "strongly_connected_components"),
    "networkx: loops that nothing leaves": (nx, "attracting_components"),
    "networkx: dominators": (nx, "immediate_dominators"),
    "Jinja2": (jinja2.Template, "render"),
    "Black": (black, "format_str"),
}
"""What each does, and the function of its documentation that we call for it."""


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """Count the calls of each, which go on to the tools themselves."""
    counted: Counter[str] = Counter()

    def counting(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def counts(*given: Any, **named: Any) -> Any:
            counted[name] += 1
            return function(*given, **named)

        return counts

    for name, (owner, attribute) in CHOSEN.items():
        monkeypatch.setattr(owner, attribute, counting(name, getattr(owner, attribute)))
    return counted


def test_a_compile_calls_every_chosen_tool(
    calls: Counter[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And so does each compile after it: what came out before is not kept anywhere."""
    monkeypatch.chdir(tmp_path)
    Path("app.pluto").write_text(SOUND)
    package = tmp_path / "package"
    assert main(["compile", "app.pluto", "-o", "package"]) == 0
    first = Counter(calls)
    assert set(first) == set(CHOSEN)
    written = [p for p in package.rglob("*.py") if "_runtime" not in p.parts]
    assert first["Black"] == len(written)
    assert first["Jinja2"] == len(written) + len(("README.md", "pyproject.toml", ".gitattributes"))
    Path("app.pluto").write_text(SOUND.replace("attempts: 3", "attempts: 4"))
    assert main(["compile", "app.pluto", "-o", "package"]) == 0
    assert set(calls - first) == set(CHOSEN)
