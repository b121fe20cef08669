"""What may be written where a statement begins: whole statements that the app still lacks."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.block import IN_GRAPH
from plutoc.graph.model import END
from plutoc.report.block_page import first_line
from plutoc.service.answers import Sort
from plutoc.service.completion.arguments import required
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.declarations import keyword, names
from plutoc.service.completion.flows import blocks
from plutoc.service.completion.hole import Hole
from plutoc.service.known import Known
from plutoc.service.reading import describe
from plutoc.service.symbols import Role
from plutoc.syntax.tokens import ARROW, EQUAL
from plutoc.syntax.tree import CategoryDecl, VersionDecl

_EDGES, _LACKING, _WORDS, _NEW_BLOCKS = 0, -100, 500, 600
_MOST_EDGES = 20


def statement(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what a statement may begin with."""
    if hole.next == EQUAL:
        yield from names(Role.BLOCK, known)
    elif hole.next in (ARROW, "COMMA", "RSQB"):
        yield from blocks(hole, known)
    elif hole.behind:
        yield from (keyword(word) for word in _FORMS)
    else:
        yield from _declarations(known)
        yield from _edges(known)
        yield from _keywords(known)


_NAMED = ("category", "action", "evaluator", "modifier", "policy", "event", "creator")
_FORMS = (*_NAMED, "version", "requires", "result")
_FIELDS = {"mission": "mission has patient: text", "trip": 'trip has note: text = ""'}


def _keywords(known: Known) -> Iterator[Candidate]:
    first = {word: next(iter(names(Role(word), known))).label for word in _NAMED}
    forms = {word: f"{word} {name}" for word, name in first.items()}
    forms["category"] += f" can {', '.join(known.usual)}"
    forms["requires"] = 'requires "numpy>=2"'
    forms |= _FIELDS
    forms["result"] = f"result {known.actions[0]} as handling"
    if not any(isinstance(one, VersionDecl) for one in known.file.app.statements):
        forms["version"] = 'version "0.1.0"'
    has_category = any(isinstance(one, CategoryDecl) for one in known.file.app.statements)
    for i, (word, form) in enumerate(forms.items()):
        lacking = known.lacking.get(Role(word)) if i < len(first) else None
        rank = _LACKING if lacking or (word == "category" and not has_category) else _WORDS
        yield keyword(word, form, rank=rank + i)


def _declarations(known: Known) -> Iterator[Candidate]:
    """Give declarations: of blocks that are used already, and of new ones."""
    lacking = known.lacking.get(Role.BLOCK, ())[:2]
    for written, block in known.kinds.items():
        for name in lacking or (known.names_for(written),):
            label = f"{name} = {written}"
            yield Candidate(
                label=label,
                kind=Sort.STATEMENT,
                forms=tuple(label + given for given in required(known, written)),
                detail=first_line(block),
                doc=describe.of_kind(written, block),
                rank=_LACKING if lacking else _NEW_BLOCKS,
                judged=bool(lacking),
            )


def _edges(known: Known) -> Iterator[Candidate]:
    """Give arrows that take statuses that no arrow takes yet."""
    given = 0
    lonely = [name for name in known.blocks if not known.graph.incoming.get(name)]
    every = tuple(dict.fromkeys((*lonely, *known.blocks[:_MOST_EDGES], END)))
    for name in (*known.own_sources, *known.blocks):
        free = known.leaves(name) - known.taken_from(name)
        if not free or (name not in known.blocks and known.graph.outgoing.get(name)):
            continue
        targets = [target for target in every if target != name and free & known.accepts(target)]
        for target in targets[:4]:
            passing = [s for s in IN_GRAPH if s in free & known.accepts(target)]
            first = not known.graph.outgoing.get(name)
            guards = [""] if first else [f" when {status.value}" for status in passing]
            for guard in guards:
                label = f"{name} -> {target}{guard}"
                rank = _EDGES + given
                yield Candidate(
                    label=label,
                    kind=Sort.STATEMENT,
                    detail="an arrow",
                    rank=rank,
                    judged=True,
                )
                given += 1
                if given >= _MOST_EDGES:
                    return
