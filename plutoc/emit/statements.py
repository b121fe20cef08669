"""The lines of the flow: a plan's steps as Python statements."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from inspect import CO_ITERABLE_COROUTINE, iscoroutinefunction
from typing import Any

from plutoc.block import Choice, EventParam, HookParam, Param
from plutoc.emit.callables import WATCH, Names, chosen
from plutoc.emit.embed import Carried
from plutoc.emit.python import call, items, literal
from plutoc.graph.model import Node, Plain
from plutoc.plan.bodies import falls
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
    Join,
    Loop,
    Place,
    Step,
    Switch,
    Watch,
)
from plutoc_runtime.domain.fields import Entity, Field
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Scope:
    """What the lines around a statement settle."""

    names: Names
    fields: Mapping[str, Field]
    """The fields that exist in this app."""
    left_out: frozenset[tuple[str, str]]
    """Blocks and their parameters that are not handed over."""
    mission: str
    """How the mission is reached here."""
    declared: Mapping[str, str] = field(default_factory=dict)
    """The statuses that blocks of other packages may give, as Python has them."""
    head: str = ""
    """Where the innermost loop begins."""
    place: str = "run.at"
    """Where a mission goes on that was interrupted."""
    notes: bool = True
    """Where the mission waits is noted here; in a branch it waits at the fork."""
    in_loop: bool = False
    """A loop of the plan lies between here and the `Dispatch` around it."""


def body_lines(body: Body, scope: Scope) -> Iterator[str]:
    """Yield the lines of a body, without indentation of its own."""
    for before, step, following in zip((None, *body), body, (*body[1:], None), strict=False):
        match step:
            case Call(node=node):
                yield f"# {node.declaration}"
                is_ours = node.block.step.__module__.startswith(_OURS)
                if not is_ours or (_waits(node.block.step) and not node.block.named):
                    yield from _noted((node.name,), scope)
                yield from _go_through(_call(node, (), scope), following)
            case Join(gate=gate, branches=branches):
                yield f"# {_picture(step)}"
                yield from _noted(_firsts(step), scope)
                functions = tuple(branch.name for branch in branches if not branch.idle)
                yield from _go_through(_call(gate, functions, scope), following)
            case Watch():
                yield f"# {_watched(step)}"
                yield from _noted(_names_watched(step), scope)
                first, *rest = _wait(step, scope)
                yield from (*_go_through(first, following), *rest)
            case Switch():
                yield from _switch(step, scope)
            case Arrived():
                yield f"{scope.place} = None"
            case Loop(head=head, body=inner):
                yield "while True:"
                yield from _indented(body_lines(inner, replace(scope, head=head, in_loop=True)))
            case Continue() | Break() if not scope.in_loop:
                raise AssertionError("a jump of a loop outside of any loop")
            case Continue():
                yield f"continue  # -> {scope.head}"
            case Break():
                yield f"break{_whither(before)}"
            case End():
                yield from () if returns_at_once(body) else ("return status",)
            case Goto(label=label):
                if scope.in_loop:
                    raise AssertionError(f"a jump to {label} out of a loop cannot be written")
                yield f"at = {literal(label)}"
                yield "continue"
            case Dispatch():
                yield from _dispatch(step, scope)


_OURS = "plutoc_blocks."
"""What our own blocks' steps are in: those of others may fail anywhere."""


def _whither(before: Step | None) -> str:
    """Return where a jump leads that is what a switch leaves over."""
    match before:
        case Switch(arms=(*_, Arm(body=(), to=to))):
            return f"  # -> {to}"
        case _:
            return ""


def returns_at_once(body: Body) -> bool:
    """Return whether a body ends by returning what its last block gives."""
    return len(body) > 1 and isinstance(body[-1], End) and isinstance(body[-2], Call | Join | Watch)


def _go_through(called: str, following: Step | None) -> Iterator[str]:
    yield f"return {called}" if isinstance(following, End) else f"status = {called}"


def _call(node: Node, branches: tuple[str, ...], scope: Scope) -> str:
    step = Carried(package=node.package, function=node.step)
    arguments = ("run", "status", *branches, *_keywords(node, scope))
    called = call(scope.names[step], arguments)
    called = f"await {called}" if _waits(node.step) else called
    given = scope.declared.get(node.name)
    return call("declared", (literal(node.name), called, given)) if given else called


def _waits(step: Callable[..., Any]) -> bool:
    """Return whether a step is awaited: an `async def`, or what `types.coroutine` has made one."""
    flags: int = getattr(getattr(step, "__code__", None), "co_flags", 0)
    return iscoroutinefunction(step) or bool(flags & CO_ITERABLE_COROUTINE)


def _wait(watch: Watch, scope: Scope) -> Iterator[str]:
    """Yield a wait; where it stands for several blocks, a limit a line and its declaration above."""
    limits: list[tuple[str, str]] = []
    for node in watch.watchers:
        if node.limit is not None:
            function = scope.names[Carried(package=node.package, function=node.limit)]
            limits.append((node.declaration, call(function, ("run", *_keywords(node, scope)))))
    name = scope.names[WATCH]
    if limits and isinstance(watch.instead, Join):
        lines = [line for text, limit in limits for line in (f"    # {text}", f"    {limit},")]
        yield from (f"await {name}(", "    run,", *lines, ")")
    else:
        yield f"await {call(name, ('run', *(limit for _, limit in limits)))}"


def _watched(watch: Watch) -> str:
    match watch.instead:
        case Call():
            return ", ".join(node.declaration for node in watch.watchers)
        case Join() as join:
            return _picture(join)


def _names_watched(watch: Watch) -> tuple[str, ...]:
    match watch.instead:
        case Call():
            return tuple(node.name for node in watch.watchers)
        case Join() as join:
            return _firsts(join)


def _noted(blocks: Iterable[str], scope: Scope) -> Iterator[str]:
    """Yield the statement that notes at which blocks the mission waits."""
    if scope.notes:
        yield f"run.state.block = {literal(', '.join(blocks))}"


def _keywords(node: Node, scope: Scope) -> Iterator[str]:
    block = node.block
    if block.named:
        yield f"block={literal(node.name)}"
    for param in node.handed:
        match param:
            case Param(name=name) if (node.name, name) not in scope.left_out:
                yield f"{name}={literal(dict(node.values).get(name))}"
            case EventParam(name=name):
                yield f"{name}={literal(node.event)}"
            case HookParam():
                yield f"hook={_hook(node)}"
                if param.instead and node.hook and node.passed:
                    yield f"own={literal(node.hook.name)}"
            case Choice(name=name):
                yield f"{name}={_choice(node, param, scope)}"
            case _:
                pass
    if block.emits_by_hook and node.hook and node.hook.emits:
        yield f"emits={_any_of(node.hook.emits)}"
    for one in asked_for(node, scope):
        place = scope.mission if one.on is Entity.MISSION else "run.trip"
        yield f"{one.name}={place}.{one.name}"


def asked_for(node: Node, scope: Scope) -> tuple[Field, ...]:
    """Return the fields whose values a block gets."""
    used = (scope.fields[name] for name in node.block.uses if name in scope.fields)
    own = (field for field in node.block.needs if field.name not in node.block.reads)
    return (*own, *used)


def _hook(node: Node) -> str:
    if node.hook is None:
        return "None"
    function = f"hooks.{node.hook.name}"
    return bound(function, node.passed)


def bound(function: str, values: Iterable[tuple[str, Plain]]) -> str:
    """Return a function that is given these values each time."""
    passed = [f"{name}={literal(value)}" for name, value in values]
    return call("partial", (function, *passed)) if passed else function


def _choice(node: Node, choice: Choice, scope: Scope) -> str:
    function, hook = chosen(node, choice)
    if function is None:
        return f"hooks.{hook}"
    name = scope.names[Carried(package=node.package, function=function)]
    return f"{name}(hooks.{hook})" if hook else name


def _picture(join: Join) -> str:
    """`launch -> [watch, timer] -> first = GateFIFO`."""
    return f"{join.fork.name} -> [{', '.join(_firsts(join))}] -> {join.gate.declaration}"


def _firsts(join: Join) -> tuple[str, ...]:
    """Return the block with which each branch of a fork begins."""
    return tuple(branch.path.split(" -> ")[1] for branch in join.branches)


def _switch(switch: Switch, scope: Scope) -> Iterator[str]:
    """Yield early ways out first, flat; an arm that goes on below makes the rest its `else`."""
    written = [(arm, _arm(arm, scope)) for arm in switch.arms]
    busy = [(arm, lines) for arm, lines in written if lines]
    rest = busy[-1][0] if switch.decided and len(busy) == len(switch.arms) else None
    keyword = "if"
    for arm, lines in busy:
        if arm is rest and keyword == "if":
            yield from lines
        else:
            yield "else:" if arm is rest else f"{keyword} {_condition(arm, switch, scope)}:"
            yield from _indented(lines)
        if falls(arm.body):
            keyword = "elif"
    if not switch.decided:
        idle = tuple(status for arm, lines in written if not lines for status in arm.statuses)
        yield from _nothing_else(keyword, idle)


def _nothing_else(keyword: str, known: tuple[Status, ...]) -> Iterator[str]:
    """Yield what a plain plan asks last: no other status than these can come here."""
    if known:
        yield f"{keyword} {_is_not(known)}:"
        yield "    raise AssertionError(status)"
    elif keyword == "elif":
        yield "else:"
        yield "    raise AssertionError(status)"
    else:
        yield "raise AssertionError(status)"


def _arm(arm: Arm, scope: Scope) -> list[str]:
    if arm.body[:1] == (Break(),):
        return [f"break  # -> {arm.to}"]
    return list(body_lines(arm.body, scope))


def _is_not(statuses: tuple[Status, ...]) -> str:
    if len(statuses) == 1:
        return f"status is not {statuses[0].name}"
    return f"status not in {_any_of(statuses)}"


def _condition(arm: Arm, switch: Switch, scope: Scope) -> str:
    if arm.places:
        others = tuple(p for other in switch.arms if other is not arm for p in other.places)
        return _among(scope.place, arm.places, others)
    if len(arm.statuses) == 1:
        return f"status is {arm.statuses[0].name}"
    return f"status in {_any_of(arm.statuses)}"


def _among(name: str, places: tuple[Place, ...], others: tuple[Place, ...]) -> str:
    """Return the shorter of two questions: is it one of these, or none of the others?

    Of two that are as short it is the first: a further block behind here does not change it.
    """
    if len(places) <= len(others) + 1:
        if len(places) > 1:
            return f"{name} in {items(map(literal, places))}"
        return f"{name} is None" if places == (None,) else f"{name} == {literal(places[0])}"
    if len(others) > 1:
        return f"{name} not in {items(map(literal, others))}"
    return f"{name} != {literal(others[0])}"


def _any_of(statuses: tuple[Status, ...]) -> str:
    return items(status.name for status in statuses)


def _dispatch(dispatch: Dispatch, scope: Scope) -> Iterator[str]:
    first = literal(dispatch.start)
    yield f"at = run.at or {first}" if dispatch.entries else f"at = {first}"
    yield "while True:"
    yield "    match at:"
    for case in dispatch.cases:
        yield f"        case {literal(case.label)}:"
        inner = replace(scope, in_loop=False)
        yield from _indented(_indented(_indented(_at_the_end(case.body, inner))))


def _at_the_end(body: Body, scope: Scope) -> Iterator[str]:
    """Yield the lines of a body at whose end the loop around it begins again anyway."""
    match body:
        case (*before, Goto(label=label)) if not (before and _leads_on(before[-1])):
            yield from body_lines(tuple(before), scope)
            yield f"at = {literal(label)}"
        case (*before, Switch(arms=(*early, _)) as switch, Goto() as last) if _leads_on(switch):
            yield from body_lines(tuple(before), scope)
            keyword = "if"
            for arm in early:
                yield f"{keyword} {_condition(arm, switch, scope)}:"
                yield from _indented(_at_the_end(arm.body, scope))
                keyword = "elif"
            yield "else:"
            yield from _indented(_at_the_end((last,), scope))
        case _:
            yield from body_lines(body, scope)


def _leads_on(step: Step) -> bool:
    """Return whether a step is a switch of which every way but the last leads elsewhere."""
    match step:
        case Switch(arms=(*early, Arm(body=())), decided=True):
            return bool(early) and not any(falls(arm.body) for arm in early)
        case _:
            return False


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"    {line}" for line in lines)
