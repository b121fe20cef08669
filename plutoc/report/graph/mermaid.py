"""The graph as Mermaid text, which GitHub and GitLab draw in a README."""

from __future__ import annotations

from plutoc.check.model import Checked
from plutoc.report.graph.picture import Arrow, Box, Shape, picture

_SHAPES = {
    Shape.START: '(["{}"])',
    Shape.END: '(["{}"])',
    Shape.GATE: '{{{{"{}"}}}}',
    Shape.BLOCK: '["{}"]',
}

_PLAIN = " ,.'()-"


def mermaid(checked: Checked) -> str:
    """Return the graph as a Mermaid flowchart; thick arrows are the branches of a fork."""
    drawn = picture(checked)
    lines = ["---", f"title: {_title(drawn.title)}", "---", "flowchart TD"]
    lines.extend(f"    {_box(box)}" for box in drawn.boxes)
    lines.extend(f"    {_arrow(arrow)}" for arrow in drawn.arrows)
    return "\n".join(lines) + "\n"


def _box(box: Box) -> str:
    text = f"{box.name}<br/>{box.kind}" if box.kind else box.name
    return _id(box.name) + _SHAPES[box.shape].format(text)


def _arrow(arrow: Arrow) -> str:
    line = "-.->" if arrow.implicit or not arrow.statuses else "==>" if arrow.fork else "-->"
    label = f'|"{"<br/>".join(arrow.statuses)}"|' if arrow.statuses else ""
    return f"{_id(arrow.source)} {line}{label} {_id(arrow.target)}"


def _id(name: str) -> str:
    """A name that is no word of Mermaid's, such as `end`."""
    return f"b_{name}"


def _title(text: str) -> str:
    """A YAML string; what could mean something to YAML or to Mermaid is written as a number."""
    return (
        '"' + "".join(c if c.isalnum() or c in _PLAIN else f"\\U{ord(c):08x}" for c in text) + '"'
    )
