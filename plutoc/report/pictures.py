"""Pictures of a checked graph, with the statuses on every edge: Mermaid, Graphviz, SVG and JSON."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum
from json import dumps
from shutil import which

from plutoc.check.flow import ordered
from plutoc.check.model import Checked
from plutoc.graph.model import END, START

_PLAIN = " ,.'()-"
Ids = Mapping[str, str]


class Shape(Enum):
    """What a box stands for."""

    START = "where missions begin"
    EVENT = "where events come from"
    END = "where missions end"
    GATE = "where forks close"
    BLOCK = "any other block"


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A block, `start` or `end`, or an event."""

    name: str
    kind: str
    """Empty for all but blocks."""
    shape: Shape


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """An edge, with the statuses that pass along it."""

    source: str
    target: str
    statuses: tuple[str, ...]
    fork: bool
    """It is a branch of a fork."""
    implicit: bool
    """The source has no such edge: missions end there all the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A graph as it is drawn."""

    title: str
    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...]


def picture(checked: Checked) -> Picture:
    """Return what there is to draw."""
    graph = checked.graph
    branches = {edge for fork in checked.forks for edge in fork.branches}
    arrows = [
        Arrow(
            source=edge.source,
            target=edge.target,
            statuses=tuple(status.value for status in ordered(checked.carries[edge])),
            fork=edge in branches,
            implicit=False,
        )
        for edge in graph.edges
    ]
    for name in graph.node:
        left = tuple(status.value for node, status in checked.implicit_ends if node == name)
        if left:
            arrows.append(Arrow(source=name, target=END, statuses=left, fork=False, implicit=True))
    boxes = [
        Box(name=name, kind="", shape=Shape.START if name == START else Shape.EVENT)
        for name in graph.sources
    ]
    boxes.extend(
        Box(
            name=node.name,
            kind=node.block.name,
            shape=Shape.BLOCK if node.block.gate is None else Shape.GATE,
        )
        for node in graph.nodes
    )
    if any(arrow.target == END for arrow in arrows):
        boxes.append(Box(name=END, kind="", shape=Shape.END))
    return Picture(title=graph.title or graph.name, boxes=tuple(boxes), arrows=tuple(arrows))


_MERMAID_SHAPES = {
    Shape.START: '(["{}"])',
    Shape.EVENT: '>"{}"]',
    Shape.END: '(["{}"])',
    Shape.GATE: '{{{{"{}"}}}}',
    Shape.BLOCK: '["{}"]',
}


def mermaid(checked: Checked) -> str:
    """Return the graph as a Mermaid flowchart; thick arrows are the branches of a fork."""
    drawn = picture(checked)
    ids = _ids(drawn.boxes)
    lines = ["---", f"title: {_mermaid_title(drawn.title)}", "---", "flowchart TD"]
    lines.extend(f"    {_mermaid_box(box, ids)}" for box in drawn.boxes)
    lines.extend(f"    {_mermaid_arrow(arrow, ids)}" for arrow in drawn.arrows)
    return "\n".join(lines) + "\n"


def _mermaid_box(box: Box, ids: Ids) -> str:
    text = f"{box.name}<br/>{box.kind}" if box.kind else box.name
    return ids[box.name] + _MERMAID_SHAPES[box.shape].format(text)


def _mermaid_arrow(arrow: Arrow, ids: Ids) -> str:
    line = "-.->" if arrow.implicit or not arrow.statuses else "==>" if arrow.fork else "-->"
    label = f'|"{"<br/>".join(arrow.statuses)}"|' if arrow.statuses else ""
    return f"{ids[arrow.source]} {line}{label} {ids[arrow.target]}"


def _ids(boxes: Iterable[Box]) -> Ids:
    """Return what the boxes are called within the text.

    The first block of a kind goes by its kind: to rename it changes one line of a README. A
    further one has its name behind, so that it renames no other. All begin with a capital: words of
    Mermaid's, such as `end`, do not.
    """
    ids = {START: "Start", END: "End"}
    taken = set(ids.values())
    for box in boxes:
        if box.name not in ids:
            kind = f"{box.kind[:1].upper()}{box.kind[1:]}" or "Event"
            found = f"{kind}_{box.name}" if kind in taken else kind
            while found in taken:
                found += "_"
            ids[box.name] = found
            taken.add(found)
    return ids


def _mermaid_title(text: str) -> str:
    """A YAML string; what could mean something to YAML or to Mermaid is written as a number."""
    return (
        '"' + "".join(c if c.isalnum() or c in _PLAIN else f"\\U{ord(c):08x}" for c in text) + '"'
    )


_DOT_SHAPES = {
    Shape.START: "shape=circle",
    Shape.EVENT: "shape=cds",
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
        *(f"    {_dot_box(box)}" for box in drawn.boxes),
        *(f"    {_dot_arrow(arrow)}" for arrow in drawn.arrows),
        "}",
    ]
    return "\n".join(lines) + "\n"


def _dot_box(box: Box) -> str:
    label = f'"{box.name}\\n{box.kind}"' if box.kind else _quoted(box.name)
    return f"{_quoted(box.name)} [{_DOT_SHAPES[box.shape]}, label={label}];"


def _dot_arrow(arrow: Arrow) -> str:
    style = "dashed" if arrow.implicit or not arrow.statuses else "bold" if arrow.fork else "solid"
    label = "\\n".join(f" {status} " for status in arrow.statuses)  # apart from the line
    return f'{_quoted(arrow.source)} -> {_quoted(arrow.target)} [label="{label}", style={style}];'


def _quoted(text: str) -> str:
    """A Graphviz string that shows this very text: no escapes, no HTML entities in it."""
    shown = text.replace("&", "&amp;").replace("\\", "\\\\").replace('"', '\\"')
    return f'"{shown}"'


class NoGraphviz(Exception):
    """Graphviz is not there, or it could not draw. The text says what to do."""


def dot_to_svg(text: str) -> str:
    """Have Graphviz draw what `dot` wrote; raise `NoGraphviz` where that fails."""
    program = which("dot")
    if program is None:
        raise NoGraphviz(
            "SVG pictures are drawn by Graphviz, and its program `dot` was not found: "
            "install Graphviz (https://graphviz.org/download/), or use `--format mermaid`"
        )
    done = subprocess.run(
        [program, "-Tsvg"],
        input=text,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    if done.returncode:
        raise NoGraphviz(f"Graphviz could not draw the graph: {done.stderr.strip()}")
    return done.stdout


def json(checked: Checked) -> str:
    """Return the graph as one JSON object; lines count from 1."""
    graph = checked.graph
    return (
        dumps(
            {
                "app": graph.name,
                "blocks": [
                    {
                        "name": node.name,
                        "kind": node.block.name,
                        "line": graph.source.position(node.name_span.start)[0],
                        "resumes_at": list(checked.resumes[node.name]),
                    }
                    for node in graph.nodes
                ],
                "edges": [
                    {
                        "from": arrow.source,
                        "to": arrow.target,
                        "statuses": list(arrow.statuses),
                        "fork": arrow.fork,
                        "implicit": arrow.implicit,
                    }
                    for arrow in picture(checked).arrows
                ],
            },
            indent=2,
        )
        + "\n"
    )
