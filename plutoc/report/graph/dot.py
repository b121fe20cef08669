"""The graph as text for Graphviz."""

from __future__ import annotations

from plutoc.check.model import Checked
from plutoc.report.graph.picture import Arrow, Box, Shape, picture

_SHAPES = {
    Shape.START: "shape=circle",
    Shape.END: "shape=doublecircle",
    Shape.GATE: "shape=hexagon",
    Shape.BLOCK: "shape=box, style=rounded",
}


def dot(checked: Checked) -> str:
    """Return the graph as a Graphviz digraph; bold arrows are the branches of a fork."""
    drawn = picture(checked)
    lines = [
        f"digraph {_quoted(checked.graph.name)} {{",
        f"    graph [label={_quoted(drawn.title)}, labelloc=t, fontname=Helvetica];",
        "    node [fontname=Helvetica, fontsize=11];",
        "    edge [fontname=Helvetica, fontsize=9];",
        *(f"    {_box(box)}" for box in drawn.boxes),
        *(f"    {_arrow(arrow)}" for arrow in drawn.arrows),
        "}",
    ]
    return "\n".join(lines) + "\n"


def _box(box: Box) -> str:
    label = f'"{box.name}\\n{box.kind}"' if box.kind else _quoted(box.name)
    return f"{_quoted(box.name)} [{_SHAPES[box.shape]}, label={label}];"


def _arrow(arrow: Arrow) -> str:
    style = "dashed" if arrow.implicit or not arrow.statuses else "bold" if arrow.fork else "solid"
    label = "\\n".join(f" {status} " for status in arrow.statuses)  # apart from the line
    return f'{_quoted(arrow.source)} -> {_quoted(arrow.target)} [label="{label}", style={style}];'


def _quoted(text: str) -> str:
    """A Graphviz string that shows this very text: no escapes, no HTML entities in it."""
    shown = text.replace("&", "&amp;").replace("\\", "\\\\").replace('"', '\\"')
    return f'"{shown}"'
