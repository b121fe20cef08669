"""`README.md`: the app's graph, its kinds of blocks, its missions file, and which file is whose."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.block import Block
from plutoc.emit.markup import fence, header, markdown, toml_text
from plutoc.emit.model_file import all_fields
from plutoc.emit.render import render
from plutoc.emit.test_file import able, sample
from plutoc.graph.model import Graph


@dataclass(frozen=True, slots=True, kw_only=True)
class KindRow:
    """A kind of block, in the README's table."""

    name: str
    doc: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldRow:
    """A field of missions or trips, in the README's table."""

    name: str
    on: str
    doc: str


def readme(graph: Graph, source_name: str, picture: str) -> str:
    """Return the text of `README.md`."""
    mission = sample(graph)
    drone = able(graph, *mission.actions) or graph.categories[0]
    return render(
        "README.md",
        header=header(source_name),
        app=graph.name,
        distribution=graph.name.rstrip("_"),
        title=markdown(graph.title),
        fence=fence(picture),
        picture=picture.rstrip("\n"),
        dotted="-.->" in picture,
        flags=len(graph.sources) > 1,
        gates=any(node.block.gate is not None for node in graph.nodes),
        kinds=[_kind(block) for block in dict.fromkeys(node.block for node in graph.nodes)],
        sample=mission,
        fields=[
            FieldRow(name=field.name, on=field.on.value, doc=markdown(field.doc))
            for field in all_fields(graph)
        ],
        category=toml_text(drone.name),
        hooks=bool(graph.actions or graph.hooks),
    )


def _kind(block: Block) -> KindRow:
    """Return what blocks of a kind do, in the one sentence that its documentation begins with."""
    doc, _, _ = block.doc.partition("\n")
    return KindRow(name=markdown(block.name), doc=markdown(doc))
