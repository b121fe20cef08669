"""Follows one clone of a mission through all its runs: is a way that a finding prints a real one?"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tests.soundness.app import App
from tests.soundness.explore import Explorer, first_block, with_tokens
from tests.soundness.kinds import R, Status, U
from tests.soundness.state import Branch, State, Token, Wrong
from tests.soundness.steps import MOST_TRIPS, landed, outcomes

HOP = re.compile(r"(\w+)(?: \(([A-Z]+)\))?")

Hop = tuple[str, Status | None]
"""A block, and the status that it is left with; None at the last one, if it is not left."""


@dataclass(frozen=True, slots=True)
class Followed:
    """A mission, and the clone of it that is followed."""

    state: State
    token: Token
    hops: int
    """The blocks that it has come to."""


def ways_in(help: str) -> tuple[tuple[Hop, ...], ...]:
    """Return the ways that a finding prints, each on lines of its own."""
    _, _, text = help.partition(" there:\n")
    lines = text.replace("\n    →", " →").splitlines()
    found = []
    for line in lines:
        hops = [HOP.fullmatch(part.strip()) for part in line.split("→")]
        assert all(hops), line
        found.append(tuple((h[1], Status(h[2]) if h[2] else None) for h in hops if h))
    return tuple(found)


def hops_to_trouble(app: App, where: str, way: Sequence[Hop] | None = None) -> int | None:
    """Return the fewest blocks on a way to trouble at this place; with a way, only along that."""
    first = first_block(app)
    assert first is not None
    explorer = Explorer(app, strict=False, patient=False)
    token = Token(first, U, ())
    begun = [
        Followed(State((token,), trips, 0, False, None), token, 1)
        for trips in range(1, MOST_TRIPS + 1)
    ]
    queue, known = deque(begun), {(f.state, f.token, 1 if way else 0) for f in begun}
    late: deque[Followed] = deque()
    while queue or late:
        at = queue.popleft() if queue else late.popleft()
        for then in _steps(explorer, at, way):
            if isinstance(then, Wrong):
                if place_of(then) == where:
                    hops = at.hops + (at.token.block != where)
                    if way is None or hops == len(way):
                        return hops
                continue
            # along a way the same blocks can be come to twice; else once is enough
            key = (then.state, then.token, then.hops if way else 0)
            if key in known:
                continue
            known.add(key)
            # what the others do costs nothing: the nearest are always looked at first
            (queue if then.hops == at.hops else late).append(then)
    return None


def place_of(wrong: Wrong) -> str:
    """Return the block at which something is wrong."""
    return str(wrong).partition(" at ")[2].partition(",")[0]


def _steps(
    explorer: Explorer, at: Followed, way: Sequence[Hop] | None
) -> Iterator[Followed | Wrong]:
    state, tracked = at.state, at.token
    if state.flight == R:
        for then in landed(state):
            yield Followed(then, tracked, at.hops)
    mine_at = state.tokens.index(tracked)
    for place, token in enumerate(state.tokens):
        rest = state.tokens[:place] + state.tokens[place + 1 :]
        if token.phase == "at":
            for then in explorer.gated(state, rest, token):
                kept = _kept(state, then, tracked, token if place == mine_at else None)
                if kept is not None:
                    yield Followed(then, kept, at.hops)
        elif token.phase == "in":
            yield from _left(explorer, at, rest, token, place == mine_at, way)


def _left(
    explorer: Explorer,
    at: Followed,
    rest: tuple[Token, ...],
    token: Token,
    mine: bool,
    way: Sequence[Hop] | None,
) -> Iterator[Followed | Wrong]:
    block = explorer.blocks[token.block]
    here = way[at.hops - 1 : at.hops + 1] if way is not None else ()
    try:
        found = outcomes(at.state, token, block, strict=False, most_flights=explorer.most_flights)
        for status, then in list(found):
            if status is None or (mine and here and here[0][1] not in (None, status)):
                continue
            come, wrongs = _routed(explorer, token, status)
            if mine:
                yield from wrongs
            moved = with_tokens(then, (*rest, *come))
            if not mine:
                yield Followed(moved, at.token, at.hops)
                continue
            for clone in come:
                if way is None or (len(here) == 2 and here[1][0] == clone.block):
                    yield Followed(moved, clone, at.hops + 1)
    except Wrong as wrong:
        if mine:
            yield wrong


def _routed(explorer: Explorer, token: Token, status: Status) -> tuple[list[Token], list[Wrong]]:
    """Return the clones that a token becomes; one that goes wrong at once stops no other."""
    arrows = explorer.leaving.get((token.block, status), [])
    come: list[Token] = []
    wrongs: list[Wrong] = []
    try:
        if len(arrows) < 2:
            return list(explorer.routed(token, status)), wrongs
    except Wrong as wrong:
        return come, [wrong]
    for index, arrow in enumerate(arrows):
        stack = (*token.stack, Branch(token.block, status, index, len(arrows)))
        try:
            come.extend(explorer.arrived(arrow.target, status, stack))
        except Wrong as wrong:
            wrongs.append(wrong)
    return come, wrongs


def _kept(state: State, then: State, tracked: Token, arriving: Token | None) -> Token | None:
    """Return what the clone that is followed has become when a gate has taken one in."""
    if arriving is None and tracked in then.tokens:
        return tracked
    waits = tracked._replace(phase="waits")
    if arriving is not None and waits in then.tokens and len(then.tokens) == len(state.tokens):
        return waits
    if arriving is None and tracked.phase != "waits":
        return None  # called off
    # what passes is what it brought: else it is another clone's way that leads on
    passed = Token(tracked.block, tracked.status, tracked.stack[:-1])
    return passed if passed in then.tokens else None
