"""`graph.json` of a package: its graph for pages, laid out, a kind, a block or an edge a line."""

from __future__ import annotations

from collections.abc import Iterable
from json import dumps

from plutoc.check.model import Checked
from plutoc.report.block_page import first_line
from plutoc.report.layout import laid_out
from plutoc.report.pictures import Arrow, Box, Shape, picture

Row = dict[str, object]
_TEXT = """\
{{
"kinds": {{
{kinds}
}},
"blocks": [
{blocks}
],
"edges": [
{edges}
]
}}
"""


def graph_file(checked: Checked) -> str:
    """Return the text of `graph.json`; what is not true of a block or an edge is left out."""
    drawn = picture(checked)
    nodes = checked.graph.nodes
    names = [node.name for node in nodes]
    spots = laid_out(
        names, [(one.source, one.target) for one in drawn.arrows], {}, checked.graph.sources[1:]
    )
    kinds = {node.block.name: first_line(node.block) for node in nodes}
    return _TEXT.format(
        kinds=",\n".join(f"{_text(kind)}: {_text(doc)}" for kind, doc in kinds.items()),
        blocks=_lines(_block(box, *spots[box.name]) for box in drawn.boxes),
        edges=_lines(map(_edge, drawn.arrows)),
    )


def _block(box: Box, x: int, y: int) -> Row:
    kind: Row = {"kind": box.kind} if box.kind else {}
    gate: Row = {"gate": True} if box.shape is Shape.GATE else {}
    event: Row = {"event": True} if box.shape is Shape.EVENT else {}
    return {"name": box.name, **kind, **gate, **event, "x": x, "y": y}


def _edge(arrow: Arrow) -> Row:
    fork: Row = {"fork": True} if arrow.fork else {}
    implicit: Row = {"implicit": True} if arrow.implicit else {}
    statuses = list(arrow.statuses)
    return {
        "source": arrow.source,
        "target": arrow.target,
        "statuses": statuses,
        **fork,
        **implicit,
    }


def _lines(rows: Iterable[Row]) -> str:
    return ",\n".join(map(_text, rows))


def _text(value: object) -> str:
    return dumps(value, ensure_ascii=False)
