"""Where a mission was interrupted is asked for only where it makes a difference.

A plan knows it as long as the mission has not come to a block that tells it to forget. So at each
question some of the places can turn up, and others cannot: those in whose stead nobody comes here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from plutoc.plan.model import (
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


class Comer(NamedTuple):
    """A mission, as far as a question can tell."""

    place: Place
    on: bool
    """It goes on already: it began, or has come to its block."""


Comers = frozenset[Comer]
NOBODY: Comers = frozenset()
GOES_ON = Comer(None, True)


class _Frame:
    """The jumps that were met in the innermost loop."""

    __slots__ = ("broken", "continued")

    def __init__(self) -> None:
        self.broken: set[Comer] = set()
        self.continued: set[Comer] = set()


class _Walk:
    def __init__(self) -> None:
        self.found: dict[int, tuple[Switch, Comers]] = {}

    def body(self, body: Body, comers: Comers, frame: _Frame) -> Comers:
        for step in body:
            comers = self.step(step, comers, frame) if comers else NOBODY
        return comers

    def step(self, step: Step, comers: Comers, frame: _Frame) -> Comers:
        """Walk a step; return who falls off its end."""
        match step:
            case Call(node=node):
                return frozenset(Comer(c.place, c.on or c.place == node.name) for c in comers)
            case Arrived():
                return frozenset((GOES_ON,))
            case Switch(arms=arms):
                if step.enters:
                    _, known = self.found.get(id(step), (step, NOBODY))
                    self.found[id(step)] = step, known | comers
                out = NOBODY
                for arm in arms:
                    some = (c for c in comers if not step.enters or c.place in arm.places)
                    out |= self.body(arm.body, frozenset(some), frame)
                return out
            case Loop(body=inner):
                return self.loop(inner, comers)
            case Continue():
                frame.continued.update(comers)
            case Break():
                frame.broken.update(comers)
            case Goto() | End() | Dispatch():
                pass
            case _:
                return comers
        return NOBODY

    def loop(self, body: Body, comers: Comers) -> Comers:
        known = NOBODY
        inside = _Frame()
        while not comers <= known:
            known |= comers
            comers = self.body(body, known, inside) | inside.continued
        return frozenset(inside.broken)


def comers(body: Body, places: tuple[str, ...]) -> Mapping[int, tuple[Switch, Comers]]:
    """Return each question with who comes to it, by its identity."""
    walk = _Walk()
    begin = {GOES_ON, *(Comer(place, False) for place in places)}
    walk.body(body, frozenset(begin), _Frame())
    return walk.found


def asked_once(body: Body, places: tuple[str, ...]) -> Body:
    """Return a body in which nothing is asked whose answer is certain."""
    if not places:
        return body
    found = comers(body, places)

    def asked(step: Step, before: Step) -> Body:
        if not isinstance(step, Switch) or not step.enters:
            return (step,)
        _, here = found.get(id(before), (step, NOBODY))
        came = {comer.place for comer in here}
        narrowed = (
            replace(arm, places=tuple(place for place in arm.places if place in came))
            for arm in step.arms
        )
        left = tuple(arm for arm in narrowed if arm.places)
        if not left:
            return (step,)  # nobody ever comes here
        return left[0].body if len(left) == 1 else (replace(step, arms=left),)

    return rewritten_body(body, asked)
