"""What is said of blocks: how they are set, and which are new, gone or called otherwise."""

from __future__ import annotations

from plutoc.block import Block, Choice, Param
from plutoc.diagnostic import Diagnostic
from plutoc.diff.both import Side
from plutoc.diff.model import Change, Fact, Importance, one_sided
from plutoc.diff.phrases import a_kind, amount, so_often
from plutoc.diff.roles import Role, limited, role
from plutoc.graph.model import Node, Parameter, Plain
from plutoc_runtime.domain.fields import Entity


def _set(
    kind: str, importance: Importance, sentence: str, nodes: tuple[Node, Node], *facts: Fact
) -> Change:
    old, new = nodes
    before, after = facts
    return Change(
        kind=kind,
        importance=importance,
        sentence=sentence,
        blocks=(new.name,),
        before=before,
        after=after,
        was=(old.name_span,),
        now=(new.name_span,),
    )


def retries_changed(side: Side, nodes: tuple[Node, Node], was: int, now: int) -> Change:
    """A failed trip is flown more often, or less."""
    new = nodes[1]
    where = "" if side.is_only(new) else f" at `{new.name}`"
    before = f"up to {was} times" if was > 1 else "without a bound" if was == 0 else "never"
    if now == 1:
        fate = f"no longer retried{where}: a trip is flown once"
    else:
        fate = f"now retried{where}{so_often(now)}"
    sentence = f"a FAILED mission is {fate}; before, {before}"
    return _set("retries_changed", Importance.SAFETY, sentence, nodes, was, now)


def limit_changed(
    nodes: tuple[Node, Node], param: Param, was: Plain | None, now: Plain | None
) -> Change:
    """What limits flights that name no limit of their own is another time."""
    block = nodes[1].block
    what, on = limited(block), _entity(block)
    before = "there was no limit" if was is None else f"it was {amount(was, param.type)}"
    after = "there is no limit now" if now is None else f"it is now {amount(now, param.type)}"
    sentence = f"where {on} names no {what}, {after}; before, {before}"
    return _set("limit_changed", Importance.SAFETY, sentence, nodes, was, now)


def _entity(block: Block) -> str:
    return f"a {block.needs[0].on.value if block.needs else Entity.TRIP.value}"


def parameter_changed(
    nodes: tuple[Node, Node], param: Param, was: Plain | None, now: Plain | None
) -> Change:
    """A parameter has another value."""
    before = "it was not set" if was is None else f"it was {amount(was, param.type)}"
    after = "not set any more" if now is None else f"now {amount(now, param.type)}"
    sentence = (
        f"`{param.name}` of `{nodes[1].name}` is {after}; before, {before}{_about(param.doc)}"
    )
    return _set("parameter_changed", Importance.MISSIONS, sentence, nodes, was, now)


def choice_changed(
    side: Side, nodes: tuple[Node, Node], choice: Choice, was: str, now: str
) -> Change:
    """One of several ways to do it is chosen instead of another."""
    new = nodes[1]
    if new.block.allocates:
        where = "" if side.is_only(new) else f" at `{new.name}`"
        sentence = f"a mission's drone is now chosen{where} by `{now}`; before, by `{was}`"
    else:
        about = _about(choice.doc)
        sentence = f"`{choice.name}` of `{new.name}` is now `{now}`; before, `{was}`{about}"
    return _set("choice_changed", Importance.MISSIONS, sentence, nodes, was, now)


def _about(doc: str) -> str:
    """What a parameter is, in brackets: the first sentence of its documentation."""
    first = doc.split(". ")[0].strip().rstrip(".")
    return f" ({first[:1].lower()}{first[1:]})" if first else ""


def evaluator_changed(side: Side, nodes: tuple[Node, Node], was: str, now: str) -> Change:
    """Another hook judges missions."""
    where = "" if side.is_only(nodes[1]) else f" at `{nodes[1].name}`"
    sentence = (
        f"a mission that names no evaluator is now judged{where} by `{now}`; before, by `{was}`"
    )
    return _set("evaluator_changed", Importance.MISSIONS, sentence, nodes, was, now)


def hook_changed(nodes: tuple[Node, Node], was: str | None, now: str | None) -> Change:
    """A block calls another hook."""
    calls = f"now calls `{now}`" if now else "calls no hook any more"
    before = f"it called `{was}`" if was else "it called none"
    sentence = f"`{nodes[1].name}` {calls}; before, {before}"
    return _set("hook_changed", Importance.MISSIONS, sentence, nodes, was, now)


def passed_changed(
    nodes: tuple[Node, Node], parameter: Parameter, was: Plain, now: Plain
) -> Change:
    """A block calls its hook with another value."""
    new, kind = nodes[1], parameter.type
    hook = new.hook.name if new.hook else new.name
    sentence = (
        f"`{new.name}` now calls `{hook}` with `{parameter.name}` {amount(now, kind)};"
        f" before, with {amount(was, kind)}"
    )
    return _set("passed_changed", Importance.MISSIONS, sentence, nodes, was, now)


def kind_changed(nodes: tuple[Node, Node], was: str, now: str) -> Change:
    """A block of the same name is of another kind."""
    sentence = f"`{nodes[1].name}` is now {a_kind(now)}; before, {a_kind(was)}"
    told = role(nodes[0]) is role(nodes[1]) and role(nodes[1]) in (Role.GATE, Role.LIMITS)
    importance = Importance.FORM if told else Importance.MISSIONS
    return _set("kind_changed", importance, sentence, nodes, was, now)


def block_renamed(old: Node, new: Node, alone: bool) -> Change:
    """A block has another name."""
    rest = "; nothing else about it changes" if alone else ""
    sentence = f"block `{old.name}` is now called `{new.name}`{rest}"
    return _set("block_renamed", Importance.FORM, sentence, (old, new), old.name, new.name)


def block_of_one(node: Node, *, is_new: bool) -> Change:
    """Only one of the apps has such a block."""
    return one_sided(
        "block_added" if is_new else "block_removed",
        Importance.FORM,
        f"block `{node.name}` is {'new' if is_new else 'gone'}, {a_kind(node.block.name)}",
        blocks=(node.name,),
        fact=node.block.name,
        spans=(node.name_span,),
        is_new=is_new,
    )


def arranged_otherwise() -> Change:
    """The arrows differ, and every mission fares as before."""
    return Change(
        kind="arranged_otherwise",
        importance=Importance.FORM,
        sentence="the arrows are arranged otherwise; missions pass the same blocks as before",
    )


# Warnings


def held(awaited: str, node: Node, *, is_new: bool) -> Change:
    """A mission waits with a drone that no other can use, or does so no more."""
    if is_new:
        sentence = (
            f"a drone is held during the {awaited}: missions come to `{node.name}` with one"
            " allocated, which no other mission can use"
        )
    else:
        sentence = f"a drone is no longer held during the {awaited}"
    return one_sided(
        "held_added" if is_new else "held_removed",
        Importance.SAFETY,
        sentence,
        blocks=(node.name,),
        spans=(node.name_span,),
        is_new=is_new,
    )


def warning_of_one(
    warning: Diagnostic, importance: Importance, node: Node | None, *, is_new: bool
) -> Change:
    """The checks warn of something in one of the apps only."""
    return one_sided(
        "warning_added" if is_new else "warning_removed",
        importance,
        f"a warning is {'new' if is_new else 'gone'}: {warning.message} ({warning.code})",
        blocks=(node.name,) if node else (),
        fact=warning.code,
        spans=(warning.span,),
        is_new=is_new,
    )
