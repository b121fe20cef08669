"""`plutoc graph`, as a person calls it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call


def test_mermaid_is_the_default(plutoc: Call, app: Path) -> None:
    """With the statuses on the edges."""
    said = plutoc("graph", app)
    assert said.code == 0
    assert "flowchart TD" in said.out
    assert "STANDBY" in said.out
    assert plutoc("graph", app, "--format", "mermaid").out == said.out


def test_other_pictures_can_be_asked_for(plutoc: Call, app: Path) -> None:
    """For Graphviz, and for programs."""
    assert plutoc("graph", app, "--format", "dot").out.startswith("digraph")
    assert json.loads(plutoc("graph", app, "--format", "json").out)["app"] == "crop"


def test_without_graphviz_an_svg_ends_with_2(
    plutoc: Call, app: Path, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It says what to install."""
    monkeypatch.setenv("PATH", str(here))
    said = plutoc("graph", app, "--format", "svg")
    assert said.code == 2
    assert "Graphviz" in said.err


def test_a_graph_with_errors_is_not_drawn(plutoc: Call, app: Path) -> None:
    """It ends with 1."""
    app.write_text(APP.replace("  retry -> allocate when STANDBY\n", ""))
    said = plutoc("graph", app)
    assert said.code == 1
    assert not said.out
