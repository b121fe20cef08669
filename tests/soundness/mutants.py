"""Every app that is one edit away: an arrow less or more, another gate, another guard."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from tests.soundness.app import END, App, Arrow, Block, allowed
from tests.soundness.kinds import BUILT_IN_EVENTS, GATES

EDITS = (
    "arrow removed",
    "arrow added",
    "gate swapped",
    "guard dropped",
    "guard widened",
    "guard narrowed",
    "arrow redirected",
    "event changed",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """An app with one edit."""

    edit: str
    what: str
    app: App


def mutants(app: App) -> Iterator[Mutant]:
    """Yield every app that is one edit away; some are no app that parses and resolves."""
    for edit, what, mutant in (
        *_removed(app),
        *_added(app),
        *_swapped(app),
        *_guarded(app),
        *_redirected(app),
        *_events(app),
    ):
        yield Mutant(edit=edit, what=what, app=mutant)


_Edited = Iterator[tuple[str, str, App]]


def _removed(app: App) -> _Edited:
    for arrow in app.arrows:
        yield "arrow removed", str(arrow), _with(app, arrow)


def _added(app: App) -> _Edited:
    """Yield an arrow more: one without a guard, and one with each status that it could take."""
    names = [block.name for block in app.blocks]
    for source in (*app.sources, *names):
        for target in (*names, END):
            plain = Arrow(source=source, target=target, guard=(), otherwise=False)
            guarded = [replace(plain, guard=(status,)) for status in allowed(app, target)]
            # a source sends one status only: it has no guards
            for arrow in (plain, *guarded) if source in names else (plain,):
                if arrow not in app.arrows:
                    yield "arrow added", str(arrow), _with(app, None, arrow)


def _swapped(app: App) -> _Edited:
    for block in app.blocks:
        if block.kind in GATES:
            other = replace(block, kind=GATES[1 - GATES.index(block.kind)])
            blocks = tuple(other if b is block else b for b in app.blocks)
            yield "gate swapped", f"{other.name} = {other.kind}", _of(app, blocks, app.arrows)


def _guarded(app: App) -> _Edited:
    for arrow in app.arrows:
        if arrow.guard or arrow.otherwise:
            plain = replace(arrow, guard=(), otherwise=False)
            yield "guard dropped", str(arrow), _with(app, arrow, plain)
        if not arrow.guard:
            continue
        for status in allowed(app, arrow.target):
            if status not in arrow.guard:
                wider = replace(arrow, guard=(*arrow.guard, status))
                yield "guard widened", str(wider), _with(app, arrow, wider)
        for status in arrow.guard if len(arrow.guard) > 1 else ():
            narrower = replace(arrow, guard=tuple(s for s in arrow.guard if s != status))
            yield "guard narrowed", str(narrower), _with(app, arrow, narrower)


def _redirected(app: App) -> _Edited:
    for arrow in app.arrows:
        for target in (*(block.name for block in app.blocks), END):
            if target != arrow.target:
                other = replace(arrow, target=target)
                yield "arrow redirected", f"{arrow} to {target}", _with(app, arrow, other)


def _events(app: App) -> _Edited:
    """Yield each block that waits for an event with another one."""
    for block in app.blocks:
        for event in dict.fromkeys((*app.sources[1:], *BUILT_IN_EVENTS)) if block.event else ():
            if event != block.event:
                written = block.written.replace(f"event: {block.event}", f"event: {event}")
                other = replace(block, event=event, written=written)
                blocks = tuple(other if b is block else b for b in app.blocks)
                yield "event changed", f"{block.name} waits for {event}", _of(
                    app, blocks, app.arrows
                )


def _with(app: App, old: Arrow | None, *new: Arrow) -> App:
    arrows: list[Arrow] = []
    for arrow in app.arrows:
        arrows.extend(new if arrow == old else (arrow,))
    return _of(app, app.blocks, (*arrows, *(new if old is None else ())))


def _of(app: App, blocks: tuple[Block, ...], arrows: tuple[Arrow, ...]) -> App:
    return App(name=app.name, rest=app.rest, blocks=blocks, arrows=arrows)
