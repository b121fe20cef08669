"""One mission, flown in every way that it can go: every outcome, every order of its clones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from tests.soundness.app import END, START, App, Arrow, takes
from tests.soundness.kinds import (
    BADNESS,
    END_ACCEPTS,
    EVENT_MONITOR,
    FUNNEL,
    GATES,
    LIMITS,
    WATCHES,
    R,
    Status,
    U,
)
from tests.soundness.state import Branch, Stack, State, Token, Verdict, Wrong
from tests.soundness.steps import MOST_TRIPS, broken_off, hooks_fail, landed, outcomes
from tests.soundness.walk import Run, Walk

ENOUGH = 2_000
"""States to look at once something has gone wrong: more of them would show no more."""
TOO_MANY = 20_000


@dataclass(kw_only=True)
class Seen:
    """What was seen in all runs together."""

    wrong: dict[Verdict, Run] = field(default_factory=dict)
    """A shortest run for each verdict."""
    taken: set[tuple[Arrow, Status]] = field(default_factory=set)
    with_trips: set[tuple[Arrow, Status]] = field(default_factory=set)
    """Those of them that were taken by a mission with a trip left to fly or to be put back."""
    closed: dict[tuple[str, Status], set[str]] = field(default_factory=dict)
    """The gates at which the branches of each fork arrived."""
    limited: set[tuple[str, Stack]] = field(default_factory=set)
    """Where a limit was set to a flight: the block, and the branches that it stood in."""
    beside: set[tuple[str, Stack]] = field(default_factory=set)
    """Those of them beside which a TripMonitor was seen."""
    waited: dict[tuple[str, Status], set[tuple[str, str]]] = field(default_factory=dict)
    """The events that were waited for within each fork, and the blocks that did so."""
    states: int = 0
    cut: bool = False
    """There were too many runs to wait for."""


class Explorer:
    """Explores the runs of one app."""

    def __init__(self, app: App, *, strict: bool, patient: bool) -> None:
        self.blocks = {block.name: block for block in app.blocks}
        self.leaving: dict[tuple[str, Status], list[Arrow]] = {}
        for arrow, statuses in takes(app).items():
            for status in statuses:
                self.leaving.setdefault((arrow.source, status), []).append(arrow)
        self.strict = strict
        self.patient = patient
        """No gate calls a branch off: shows branches that would never have closed."""
        self.most_flights = max((block.limit for block in app.blocks), default=0)
        self.interrupts = any(block.kind == EVENT_MONITOR for block in app.blocks)
        self.seen = Seen()

    def explore(self, firsts: Iterable[str]) -> Seen:
        """Return what all runs show, from each block that makes missions."""
        walk = Walk()
        for first in firsts:
            for trips in range(1, MOST_TRIPS + 1):
                state = State((Token(first, U, ()),), trips, 0, False, None)
                walk.come(None, state, f"{trips} trips at {first}")
        wrong = self.seen.wrong
        while walk.queue and len(walk.came) < (ENOUGH if wrong else TOO_MANY):
            state = walk.queue.popleft()
            self.note_limits(state)
            moved = False
            for step, then, fails in self.steps(state):
                moved = True
                if isinstance(then, Wrong):
                    walk.settled.append(state)
                    wrong.setdefault(then.verdict, (*walk.run(state), f"{step}: {then}"))
                else:
                    if not fails:
                        walk.failing.discard((state, then))
                    elif then not in walk.after.get(state, ()):
                        walk.failing.add((state, then))
                    walk.come(state, then, step)
            if not state.tokens or not moved:
                walk.settled.append(state)
            if state.tokens and not moved:
                wrong.setdefault(Verdict.DEADLOCKED, walk.run(state))
        self.seen.states = len(walk.came)
        self.seen.cut = bool(walk.queue)
        if not self.seen.cut:
            for state in walk.hopeless() or walk.left_to_hooks():
                kept = Verdict.DEADLOCKED if walk.keeps_waiting(state) else Verdict.ENDLESS
                wrong.setdefault(kept, walk.run(state))
        return self.seen

    def note_limits(self, state: State) -> None:
        """Remember which limits stand beside a block that watches the flight."""
        kinds = [self.blocks[token.block].kind for token in state.tokens]
        for token, kind in zip(state.tokens, kinds, strict=True):
            if kind in LIMITS:
                self.seen.limited.add((token.block, token.stack))
                if kind == EVENT_MONITOR:
                    waits = (self.blocks[token.block].event, token.block)
                    for branch in token.stack:
                        self.seen.waited.setdefault(branch[:2], set()).add(waits)
                if WATCHES in kinds:
                    self.seen.beside.add((token.block, token.stack))

    def steps(self, state: State) -> Iterator[tuple[str, State | Wrong, bool]]:
        """Yield everything that can happen next, and whether a hook fails the mission for no need."""
        if not state.tokens:
            return
        for place, token in enumerate(state.tokens):
            # a funnel takes in what comes in any order: it makes no difference which
            if token.phase == "at" and not self.calls_off(token):
                rest = state.tokens[:place] + state.tokens[place + 1 :]
                for then in self.gated(state, rest, token):
                    yield f"{token.block} gets {token.status}", then, False
                return
        if state.flight == R:
            for then in landed(state):
                yield f"the trip ends {then.flight}", then, False
            for token in state.tokens:
                if self.blocks[token.block].kind == EVENT_MONITOR:
                    yield f"{token.block} breaks it off", broken_off(state), False
        for place, token in enumerate(state.tokens):
            if token.phase == "waits":
                continue
            rest = state.tokens[:place] + state.tokens[place + 1 :]
            if token.phase == "at":
                for then in self.gated(state, rest, token):
                    yield f"{token.block} gets {token.status}", then, False
                continue
            block = self.blocks[token.block]
            try:
                found = outcomes(
                    state, token, block, strict=self.strict, most_flights=self.most_flights
                )
                ways = list(found)
                if not ways and block.emits and state.flight != R:
                    yield f"{token.block} is at fault", with_tokens(state, ()), False
                failing = hooks_fail(state, token, block, ways)
                for status, then in ways:
                    if not self.interrupts:
                        then = then._replace(before=0)
                    if status is None:
                        yield f"{token.block} ends it", with_tokens(then, ()), False
                        continue
                    left = self.left(then, rest, token, status)
                    yield f"{token.block} {status}", left, status in failing
            except Wrong as wrong:
                yield token.block, wrong, False

    def left(
        self, state: State, rest: tuple[Token, ...], token: Token, status: Status
    ) -> State | Wrong:
        """Return the state when a mission or a clone has left its block with this status."""
        if not state.spent:
            arrows = self.leaving.get((token.block, status), [])
            self.seen.with_trips.update((arrow, status) for arrow in arrows)
        try:
            come = self.routed(token, status)
        except Wrong as wrong:
            return wrong
        return with_tokens(state, (*rest, *come))

    def routed(self, token: Token, status: Status) -> tuple[Token, ...]:
        """Return what a mission or a clone becomes when it leaves its block with this status."""
        arrows = self.leaving.get((token.block, status), [])
        self.seen.taken.update((arrow, status) for arrow in arrows)
        if not arrows:
            if status not in END_ACCEPTS:
                raise Wrong(Verdict.STUCK, token.block)
            if token.stack:
                raise Wrong(Verdict.LOST, f"{token.block}, an end within a fork")
            return ()
        if len(arrows) == 1:
            return self.arrived(arrows[0].target, status, token.stack)
        if any((b.block, b.status) == (token.block, status) for b in token.stack):
            raise Wrong(Verdict.BREEDS, token.block)
        clones: list[Token] = []
        for index, arrow in enumerate(arrows):
            branch = Branch(token.block, status, index, len(arrows))
            clones.extend(self.arrived(arrow.target, status, (*token.stack, branch)))
        return tuple(clones)

    def arrived(self, name: str, status: Status, stack: Stack) -> tuple[Token, ...]:
        """Return what comes to the end of an arrow."""
        if name == END:
            if stack:
                raise Wrong(Verdict.FLOWN_TWICE, END)
            return ()
        kind = self.blocks[name].kind
        if stack and kind in ("DroneAllocator", "TripLauncher"):
            raise Wrong(Verdict.FLOWN_TWICE, name)
        if kind not in GATES:
            return (Token(name, status, stack),)
        if not stack:
            raise Wrong(Verdict.LOST, f"{name}, a gate without a fork")
        self.seen.closed.setdefault(stack[-1][:2], set()).add(name)
        return (Token(name, status, stack, "at"),)

    def calls_off(self, token: Token) -> bool:
        """Return whether the gate where a clone is lets it pass before the others have come."""
        return self.blocks[token.block].kind != FUNNEL and not self.patient

    def gated(self, state: State, rest: tuple[Token, ...], token: Token) -> Iterator[State]:
        """Yield the state when a gate has taken in a clone: one, but for a gate that is patient."""
        outer = token.stack[:-1]
        if self.calls_off(token):
            others = tuple(t for t in rest if t.stack[: len(outer)] != outer)
            yield with_tokens(state, (*others, Token(token.block, token.status, outer)))
            return
        rest = (*rest, token._replace(phase="waits"))
        fork = [
            t
            for t in rest
            if t.phase == "waits" and t.block == token.block and t.stack[:-1] == outer
        ]
        if len(fork) < token.stack[-1].width:
            yield with_tokens(state, rest)
            return
        others = tuple(t for t in rest if t not in fork)
        statuses = sorted({t.status for t in fork}, key=BADNESS.index)
        # any of them could have been the first
        passing = statuses[-1:] if self.blocks[token.block].kind == FUNNEL else statuses
        for status in passing:
            yield with_tokens(state, (*others, Token(token.block, status, outer)))


def with_tokens(state: State, tokens: Iterable[Token]) -> State:
    return state._replace(tokens=tuple(sorted(tokens)))


def first_blocks(app: App) -> list[str]:
    """Return where missions begin, those of users first; none, where that is not well said."""
    makers = [block for block in app.blocks if block.kind == "MissionCreator"]
    plain = [block.name for block in makers if not block.hook]
    hooked = [block.name for block in makers if block.hook]
    starts = [arrow.target for arrow in app.arrows if arrow.source == START]
    led = [a.target for a in app.arrows if a.source in app.sources and a.source != START]
    well = len(plain) == 1 and starts == plain and {*led} == {*hooked}
    return [*plain, *hooked] if well else []


def unlike_bounds(app: App) -> bool:
    """Return whether retries give up at different numbers of flights."""
    bounds = {block.limit for block in app.blocks if block.kind == "PriorityManager"}
    return len(bounds - {0}) > 1
