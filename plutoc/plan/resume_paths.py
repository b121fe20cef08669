"""Remove questions about the place of interruption whose answer is certain.

A plan knows it as long as the mission has not come to a block that tells it to forget. So at each
question some of the places can turn up, and others cannot: those from which no mission comes here.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import NamedTuple

from plutoc.plan.model import (
    Arm,
    Arrived,
    Body,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Loop,
    Place,
    Step,
    Switch,
)
from plutoc.plan.rewrite import rewritten_body


class Candidate(NamedTuple):
    """A mission, as far as a question can distinguish it."""

    place: Place
    resumed: bool
    """Whether it has begun, or has reached its block."""


Candidates = frozenset[Candidate]
NONE: Candidates = frozenset()
GOES_ON = Candidate(None, True)


class _Frame:
    """The jumps that were met in the innermost loop."""

    __slots__ = ("broken", "continued")

    def __init__(self) -> None:
        self.broken: set[Candidate] = set()
        self.continued: set[Candidate] = set()


class _Walk:
    def __init__(self) -> None:
        self.found: dict[int, tuple[Switch, Candidates]] = {}

    def body(self, body: Body, candidates: Candidates, frame: _Frame) -> Candidates:
        for step in body:
            candidates = self.step(step, candidates, frame) if candidates else NONE
        return candidates

    def step(self, step: Step, candidates: Candidates, frame: _Frame) -> Candidates:
        """Walk a step; return what falls off its end."""
        match step:
            case Call(node=node):
                return frozenset(
                    Candidate(c.place, c.resumed or c.place == node.name) for c in candidates
                )
            case Arrived():
                return frozenset((GOES_ON,))
            case Switch(arms=arms):
                if step.enters:
                    _, known = self.found.get(id(step), (step, NONE))
                    self.found[id(step)] = step, known | candidates
                out = NONE
                for arm in arms:
                    some = (c for c in candidates if not step.enters or c.place in arm.places)
                    out |= self.body(arm.body, frozenset(some), frame)
                return out
            case Loop(body=inner):
                return self.loop(inner, candidates)
            case Continue():
                frame.continued.update(candidates)
            case Break():
                frame.broken.update(candidates)
            case Goto() | End() | Dispatch():
                pass
            case _:
                return candidates
        return NONE

    def loop(self, body: Body, candidates: Candidates) -> Candidates:
        known = NONE
        inside = _Frame()
        while not candidates <= known:
            known |= candidates
            candidates = self.body(body, known, inside) | inside.continued
        return frozenset(inside.broken)


def candidates(body: Body, places: tuple[str, ...]) -> Mapping[int, tuple[Switch, Candidates]]:
    """Return for each question, by identity, the missions that may reach it."""
    walk = _Walk()
    begin = {GOES_ON, *(Candidate(place, False) for place in places)}
    walk.body(body, frozenset(begin), _Frame())
    return walk.found


def asked_once(body: Body, places: tuple[str, ...], created: Collection[str]) -> Body:
    """Return a body without questions whose answer is certain.

    Which of the events that lead to `created` has made the mission is asked together with where it goes on.
    """
    if not places:
        return body
    found = candidates(body, places)

    def asked(step: Step, before: Step) -> Body:
        if not isinstance(step, Switch) or not step.enters:
            return (step,)
        _, here = found.get(id(before), (step, NONE))
        came = {candidate.place for candidate in here}
        narrowed = (
            replace(arm, places=tuple(place for place in arm.places if place in came))
            for arm in step.arms
        )
        left = tuple(arm for arm in narrowed if arm.places)
        if not left:
            return (step,)  # it is never reached
        if len(left) == 1:
            return left[0].body
        return (replace(step, arms=tuple(one for arm in left for one in _apart(arm, created))),)

    return rewritten_body(body, asked)


def _apart(arm: Arm, created: Collection[str]) -> tuple[Arm, ...]:
    """Return an arm that does no more than to ask who has made the mission as an arm for each."""
    match arm.body:
        case (Switch(arms=arms),) if any(place in created for one in arms for place in one.places):
            return arms
        case _:
            return (arm,)
