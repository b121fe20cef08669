"""What can be written at a place of an app: only what is legal there, the likeliest first."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diagnostic import Diagnostic, Severity
from plutoc.service.answers import Item
from plutoc.service.completion.arguments import arguments
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.declarations import category, fields, hook, kinds, result
from plutoc.service.completion.flows import flow
from plutoc.service.completion.hole import Hole, hole
from plutoc.service.completion.outside import outside
from plutoc.service.completion.statements import statement
from plutoc.service.completion.trial import Trial, Trials
from plutoc.service.document import Document
from plutoc.service.known import Known

MOST = 100
"""Of more completions the rest is not read: with more letters typed, others come in."""
MOST_LOOKED_UP = 5_000
"""In statements: where each trial is dear, fewer completions are tried."""
MOST_CHECKED = 50
"""In blocks: so much is checked anew at most to tell which completions fit the graph best."""


def complete(document: Document, offset: int) -> tuple[Item, ...]:
    """Return what may stand at a place of the app's text, the likeliest first."""
    place = hole(document.text, offset)
    if place is None:
        return ()
    if not place.inside:
        return _outside(document, place)
    trials = Trials(path=document.path, text=document.text, hole=place, before=document.sound)
    known = Known(
        file=trials.file, graph=trials.graph, names=trials.names, installed=trials.installed
    )
    begun = place.prefix.lower()
    found = [one for one in _inside(place, known) if one.label.lower().startswith(begun)]
    legal = _legal(trials, sorted(found, key=lambda one: one.rank))
    return tuple(_item(place, candidate, form) for candidate, form in legal)


def _inside(place: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may be meant in the app's braces, by how the statement begins."""
    match place.types:
        case ():
            yield from statement(place, known)
        case ("VERSION" | "REQUIRES", *_):
            return
        case ("MISSION" | "TRIP", *_):
            yield from fields(place, known)
        case ("RESULT", *_):
            yield from (arguments if place.opened else result)(place, known)
        case ("CATEGORY", *_):
            yield from (arguments if place.opened else category)(place, known)
        case (
            "ACTION" | "EVALUATOR" | "MODIFIER" | "POLICY" | "EVENT" | "CREATOR",
            *_,
        ):
            yield from hook(place, known)
        case (_, "EQUAL"):
            yield from kinds(known)
        case (_, "EQUAL", _, "DOT"):
            yield from kinds(known, f"{place.before[2]}.")
        case (_, "EQUAL", *_):
            if place.opened:
                yield from arguments(place, known)
        case _:
            yield from flow(place, known)


def _legal(trials: Trials, found: list[Candidate]) -> list[tuple[Candidate, str]]:
    """Return what is legal, each with what is to be written, in the order of a list."""
    legal: list[tuple[Candidate, Trial]] = []
    for candidate in found:
        trial = trials.legal(candidate.forms or (candidate.label,))
        if trial is not None:
            legal.append((candidate, trial))
        if len(legal) == MOST or trials.looked_up > MOST_LOOKED_UP:
            break
    size = len(trials.graph.nodes)
    most = min(MOST_CHECKED // size, 8) if size else 0
    judged = [one for one in legal if one[0].judged][:most] if len(legal) > 1 else []
    mixed = len(judged) < len(legal) and not all(one[0].judged for one in legal)
    before = trials.without if judged and mixed else 0
    scores = {id(one): trials.findings(one[1]) - before for one in judged}
    worst = max(scores.values(), default=0)

    def place(one: tuple[Candidate, Trial]) -> tuple[int, int]:
        unknown = worst if one[0].judged else 0
        return scores.get(id(one), unknown), one[0].rank

    return [(candidate, trial.insert) for candidate, trial in sorted(legal, key=place)]


def _outside(document: Document, place: Hole) -> tuple[Item, ...]:
    """Complete what stands outside of the app's braces: there the whole source is tried."""
    now = len(_mistakes(document))
    items: list[tuple[int, Item]] = []
    for candidate in outside(place, document.path):
        for form in candidate.forms or (candidate.label,):
            start, end = place.span
            text = document.text[:start] + form + document.text[end:]
            left = len(_mistakes(Document(path=document.path, text=text)))
            if candidate.label.startswith(place.prefix) and (not left or left < now):
                items.append((left, _item(place, candidate, form)))
                break
    least = min((left for left, _ in items), default=0)
    return tuple(item for left, item in items if left == least)


def _mistakes(document: Document) -> list[Diagnostic]:
    """Return the errors in an app's syntax and names."""
    return [one for one in document.of_names if one.severity is Severity.ERROR]


def _item(place: Hole, candidate: Candidate, form: str) -> Item:
    return Item(
        label=candidate.label,
        insert=form,
        span=place.span,
        kind=candidate.kind,
        detail=candidate.detail,
        doc=candidate.doc,
    )
