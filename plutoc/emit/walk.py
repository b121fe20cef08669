"""Ways through a plan's steps."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.graph.model import Node
from plutoc.plan.model import Body, Branch, Call, Dispatch, Join, Loop, Step, Switch, Watch


def steps(body: Body) -> Iterator[Step]:
    """Yield every step of a function, in order, without those of a fork's branches."""
    for step in body:
        yield step
        match step:
            case Loop(body=inner):
                yield from steps(inner)
            case Switch(arms=arms):
                for arm in arms:
                    yield from steps(arm.body)
            case Dispatch(cases=cases):
                for case in cases:
                    yield from steps(case.body)
            case _:
                pass


def nodes(body: Body) -> Iterator[Node]:
    """Yield the blocks that a function calls, and those for which it waits."""
    for step in steps(body):
        match step:
            case Call(node=node) | Join(gate=node):
                yield node
            case Watch(watchers=watchers):
                yield from watchers
            case _:
                pass


def branches(body: Body) -> Iterator[Branch]:
    """Yield the branches of every fork that are functions, each before those of the forks in it."""
    for step in steps(body):
        if isinstance(step, Join):
            for branch in (branch for branch in step.branches if not branch.idle):
                yield branch
                yield from branches(branch.body)
