"""Verification of a plan, after it was built and after every pass; a failure is a bug of the compiler."""

from __future__ import annotations

from keyword import iskeyword, issoftkeyword

from plutoc.block import Gate
from plutoc.graph.model import Node
from plutoc.plan import errors
from plutoc.plan.bodies import falls
from plutoc.plan.model import (
    Arm,
    Body,
    Branch,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Place,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc.plan.resume_paths import GOES_ON, candidates
from plutoc.plan.verify_paths import verify_paths
from plutoc_runtime.domain.status import Status

FLOW = "the flow"


def verify(plan: Plan) -> None:
    """Raise `BadPlan` if the plan is malformed, or does not do what the graph says."""
    names: dict[str, None] = {}
    _whole(plan.body, FLOW, names)
    _led_astray(plan)
    verify_paths(plan, FLOW)


def _whole(body: Body, where: str, names: dict[str, None]) -> None:
    """A body that is a function: it is left by `End` alone."""
    match body:
        case (Dispatch() as step,):
            _dispatch(step, where, names)
        case _:
            _body(body, where, names, in_loop=False, labels=None)
            if falls(body):
                raise errors.falls_off(where)


def _dispatch(step: Dispatch, where: str, names: dict[str, None]) -> None:
    labels: dict[str, None] = {}
    for case in step.cases:
        if case.label in labels:
            raise errors.label_twice(where, case.label)
        labels[case.label] = None
    if step.start not in labels:
        raise errors.no_label(where, step.start)
    for label in step.entries:
        if label not in labels:
            raise errors.no_label(where, label)
    for case in step.cases:
        inside = f"{where}, case {case.label}"
        _body(case.body, inside, names, in_loop=False, labels=tuple(labels))
        if falls(case.body):
            raise errors.falls_off(inside)


def _body(
    body: Body,
    where: str,
    names: dict[str, None],
    *,
    in_loop: bool,
    labels: tuple[str, ...] | None,
) -> None:
    left = False
    for step in body:
        if left:
            raise errors.after_jump(where)
        left = not falls((step,))
        _step(step, where, in_loop=in_loop, labels=labels)
        match step:
            case Join(branches=branches) | Watch(instead=Join(branches=branches)):
                for branch in branches:
                    _branch(branch, names)
            case Switch():
                for arm in step.arms:
                    _body(arm.body, where, names, in_loop=in_loop, labels=labels)
            case Loop():
                inside = f"{where}, loop {step.head}"
                _body(step.body, inside, names, in_loop=True, labels=labels)
            case _:
                pass


def _step(step: Step, where: str, *, in_loop: bool, labels: tuple[str, ...] | None) -> None:
    """Check a step but not what is inside it."""
    match step:
        case Continue() | Break() if not in_loop:
            raise errors.outside_loop(where, type(step).__name__.lower())
        case Goto() if labels is None:
            raise errors.outside_dispatch(where, step.label)
        case Goto() if labels is not None and step.label not in labels:
            raise errors.no_label(where, step.label)
        case Loop() if labels is not None:
            raise errors.loop_in_case(where)
        case Dispatch():
            raise errors.dispatch_inside(where)
        case Watch():
            own = _watchers(step.instead)
            if step.watchers[: len(own)] != own:
                raise errors.other_watchers(where)
        case Join():
            _spared(step, where)
        case Switch() if step.enters:
            _places(step.arms, where)
        case Switch():
            _arms(step.arms, where, least=2 if step.decided else 1)
        case _:
            pass


def _spared(join: Join, where: str) -> None:
    """Check that a branch without a clone is an arrow, is called off at once, or is waited for."""
    arrow = False
    waited: tuple[Node, ...] = ()
    for branch in join.branches:
        own, others = _alone(branch.body)
        free = branch.body == (End(),) if join.gate.block.gate is Gate.ALL else arrow
        if branch.idle and own and waited[: len(own)] == own:
            waited = waited[len(own) :]
            continue
        if waited:
            raise errors.other_watchers(where)
        if branch.idle and not free:
            raise errors.no_clone(where, branch.name)
        waited = others
        arrow = arrow or branch.body == (End(),)
    if waited:
        raise errors.other_watchers(where)


def _alone(body: Body) -> tuple[tuple[Node, ...], tuple[Node, ...]]:
    """Return what a branch waits for, if it only waits: its own blocks, and those beside it."""
    match body:
        case (Watch(instead=instead, watchers=watchers), End()):
            own = _watchers(instead)
            return own, watchers[len(own) :]
        case _:
            return (), ()


def _watchers(step: Step) -> tuple[Node, ...]:
    """Return the blocks that watch, of those that a wait stands for."""
    match step:
        case Call(node=node) if node.block.watches:
            return (node,)
        case Join(branches=branches):
            return tuple(node for b in branches for one in b.body for node in _watchers(one))
        case Watch(watchers=watchers):
            return watchers
        case _:
            return ()


def _arms(arms: tuple[Arm, ...], where: str, least: int) -> None:
    if len(arms) < least or not all(arm.statuses for arm in arms):
        raise errors.few_arms(where)
    taken: set[Status] = set()
    for arm in arms:
        for status in arm.statuses:
            if status in taken:
                raise errors.arms_overlap(where, status)
            taken.add(status)


def _places(arms: tuple[Arm, ...], where: str) -> None:
    taken: set[Place] = set()
    for arm in arms:
        if arm.statuses or not arm.places:
            raise errors.few_arms(where)
        for place in arm.places:
            if place in taken:
                raise errors.places_twice(where, place)
            taken.add(place)


def _led_astray(plan: Plan) -> None:
    """Check that a mission that goes on already is led nowhere else by where it was interrupted."""
    for step, found in candidates(plan.body, tuple(plan.checked.entries)).values():
        for candidate in found:
            ways = [arm.places for arm in step.arms if candidate.place in arm.places]
            if not ways or (candidate.resumed and GOES_ON in found and None not in ways[0]):
                raise errors.led_astray(FLOW, candidate.place)


def _branch(branch: Branch, names: dict[str, None]) -> None:
    name = branch.name
    if name in names:
        raise errors.name_twice(name)
    private = name.startswith("_") and not name.startswith("__") and name != "_"
    if not private or not name.isidentifier() or iskeyword(name) or issoftkeyword(name):
        raise errors.bad_name(name)
    names[name] = None
    _whole(branch.body, f"branch {name}", names)
