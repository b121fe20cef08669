"""The graph as Mermaid text, which GitHub and GitLab draw in a README."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from plutoc.check.model import Checked
from plutoc.graph.model import END, START
from plutoc.report.graph.picture import Arrow, Box, Shape, picture

_SHAPES = {
    Shape.START: '(["{}"])',
    Shape.END: '(["{}"])',
    Shape.GATE: '{{{{"{}"}}}}',
    Shape.BLOCK: '["{}"]',
}

_PLAIN = " ,.'()-"

Ids = Mapping[str, str]


def mermaid(checked: Checked) -> str:
    """Return the graph as a Mermaid flowchart; thick arrows are the branches of a fork."""
    drawn = picture(checked)
    ids = _ids(drawn.boxes)
    lines = ["---", f"title: {_title(drawn.title)}", "---", "flowchart TD"]
    lines.extend(f"    {_box(box, ids)}" for box in drawn.boxes)
    lines.extend(f"    {_arrow(arrow, ids)}" for arrow in drawn.arrows)
    return "\n".join(lines) + "\n"


def _box(box: Box, ids: Ids) -> str:
    text = f"{box.name}<br/>{box.kind}" if box.kind else box.name
    return ids[box.name] + _SHAPES[box.shape].format(text)


def _arrow(arrow: Arrow, ids: Ids) -> str:
    line = "-.->" if arrow.implicit or not arrow.statuses else "==>" if arrow.fork else "-->"
    label = f'|"{"<br/>".join(arrow.statuses)}"|' if arrow.statuses else ""
    return f"{ids[arrow.source]} {line}{label} {ids[arrow.target]}"


def _ids(boxes: Iterable[Box]) -> Ids:
    """Return what the boxes are called within the text.

    The first block of a kind goes by its kind: whoever renames it changes one line of a README. A
    further one has its name behind, so that it renames no other. All begin with a capital: words of
    Mermaid's, such as `end`, do not.
    """
    ids = {START: "Start", END: "End"}
    taken = set(ids.values())
    for box in boxes:
        if box.name not in ids:
            kind = f"{box.kind[:1].upper()}{box.kind[1:]}"
            found = f"{kind}_{box.name}" if kind in taken else kind
            while found in taken:
                found += "_"
            ids[box.name] = found
            taken.add(found)
    return ids


def _title(text: str) -> str:
    """A YAML string; what could mean something to YAML or to Mermaid is written as a number."""
    return (
        '"' + "".join(c if c.isalnum() or c in _PLAIN else f"\\U{ord(c):08x}" for c in text) + '"'
    )
