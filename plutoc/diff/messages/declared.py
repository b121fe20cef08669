"""What is said of what an app declares beside its graph, and of what people enter for it."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.block import HookKind, Param
from plutoc.diff.match import Declared, kind_of
from plutoc.diff.model import Change, Fact, Importance, one_sided
from plutoc.diff.phrases import amount, code, listed, named
from plutoc.graph.model import Action, Category, Graph, Hook, Library, Node, Parameter
from plutoc.source import Span
from plutoc_runtime.domain.actions import RECKONED
from plutoc_runtime.domain.fields import Entity, Field
from plutoc_runtime.domain.quantities import Type


def told(
    kind: str,
    sentence: str,
    facts: tuple[Fact, Fact] = (None, None),
    was: Span | None = None,
    now: Span | None = None,
    importance: Importance = Importance.PEOPLE,
) -> Change:
    """Return a change of what is declared at these places."""
    return Change(
        kind=kind,
        importance=importance,
        sentence=sentence,
        before=facts[0],
        after=facts[1],
        was=(was,) if was else (),
        now=(now,) if now else (),
    )


# The app


def app_renamed(old: Graph, new: Graph) -> Change:
    """The app has another name."""
    return told(
        "app_renamed",
        f"the app is now called `{new.name}`, and so are its package and its program; before,"
        f" `{old.name}`",
        (old.name, new.name),
        old.name_span,
        new.name_span,
    )


def title_changed(old: Graph, new: Graph) -> Change:
    """The app has another title."""
    return told(
        "title_changed",
        f"the title is now {code(new.title)}; before, {code(old.title)}",
        (old.title, new.title),
        old.name_span,
        new.name_span,
        Importance.FORM,
    )


def version_changed(old: Graph, new: Graph) -> Change:
    """The app's package has another version."""
    return told(
        "version_changed",
        f"the version is now {new.version}; before, {old.version}",
        (old.version, new.version),
        old.version_span or old.name_span,
        new.version_span or new.name_span,
        Importance.FORM,
    )


# What must be installed


def library_changed(was: Sequence[Library], now: Sequence[Library]) -> Change:
    """The package needs a library more or less, or in other versions or under another condition."""
    if not was:
        kind, said = "library_added", f"now requires {_required(now)}: pip installs it, too"
    elif not now:
        kind = "library_removed"
        said = f"no longer requires {_required(was)}: hooks.py cannot count on it"
    else:
        kind, said = "library_changed", f"now requires {_required(now)}; before, {_required(was)}"
    return Change(
        kind=kind,
        importance=Importance.PEOPLE,
        sentence=f"the package {said}",
        before=tuple(library.requirement for library in was) or None,
        after=tuple(library.requirement for library in now) or None,
        was=tuple(library.span for library in was),
        now=tuple(library.span for library in now),
    )


def _required(libraries: Sequence[Library]) -> str:
    return listed([code(library.requirement) for library in libraries])


# What people enter


def fields_added(on: Entity, fields: Sequence[tuple[Field, Node]]) -> Change:
    """There is something more to enter."""
    about = [f"`{field.name}` ({_small(field.doc)})" for field, _ in fields]
    sentence = f"{_OWNERS[on]} can now have {listed(about)}, in missions files"
    return _fields("fields_added", sentence, fields, is_new=True)


def fields_removed(on: Entity, fields: Sequence[tuple[Field, Node]]) -> Change:
    """There is something less to enter."""
    names = named([field.name for field, _ in fields], "or")
    them = "it" if len(fields) == 1 else "them"
    sentence = f"{_OWNERS[on]} can no longer have {names}: missions files with {them} are refused"
    return _fields("fields_removed", sentence, fields, is_new=False)


_OWNERS = {Entity.MISSION: "a mission", Entity.TRIP: "a trip"}


def _fields(
    kind: str, sentence: str, fields: Sequence[tuple[Field, Node]], *, is_new: bool
) -> Change:
    return one_sided(
        kind,
        Importance.PEOPLE,
        sentence,
        blocks=tuple(dict.fromkeys(node.name for _, node in fields)),
        fact=tuple(field.name for field, _ in fields),
        spans=tuple(dict.fromkeys(node.name_span for _, node in fields)),
        is_new=is_new,
    )


def _small(doc: str) -> str:
    return doc[:1].lower() + doc[1:].rstrip(".")


# Categories


def category_added(one: Category) -> Change:
    """There is a category more."""
    can = "do everything" if one.actions is None else listed([f"`{a}`" for a in one.actions])
    return told(
        "category_added",
        f"fleets can now have drones of the category `{one.name}`, which can {can}",
        (None, one.name),
        now=one.span,
    )


def category_removed(one: Category) -> Change:
    """There is a category less."""
    return told(
        "category_removed",
        f"there is no category `{one.name}` any more: fleet files that name it are refused",
        (one.name, None),
        was=one.span,
    )


def category_renamed(old: Category, new: Category) -> Change:
    """A category has another name, which fleet files say."""
    return told(
        "category_renamed",
        f"the category `{old.name}` is now called `{new.name}`, in fleet files, too",
        (old.name, new.name),
        old.span,
        new.span,
    )


def category_changed(old: Category, new: Category, param: Param, was: float, now: float) -> Change:
    """Drones of a category are built otherwise."""
    return told(
        "category_changed",
        f"`{param.name}` of the category `{new.name}` is now {amount(now, param.type)};"
        f" before, {amount(was, param.type)}",
        (was, now),
        old.span,
        new.span,
        Importance.SAFETY,
    )


def abilities_changed(
    old: Category, new: Category, gained: Sequence[str] | None, lost: Sequence[str] | None
) -> Change:
    """Drones of a category can do more, or less; None is everything there is."""
    said = []
    if gained is None or gained:
        said.append(f"can now {'do everything' if gained is None else named(gained)}")
    if lost is None or lost:
        no_more = "do everything" if lost is None else named(lost, "or")
        said.append(f"can no longer {no_more}")
    return told(
        "abilities_changed",
        f"drones of the category `{new.name}` {', and '.join(said)}",
        (old.actions, new.actions),
        old.span,
        new.span,
    )


# Actions and hooks

_WORDS = {
    HookKind.ACTION: "action",
    HookKind.EVALUATOR: "evaluator",
    HookKind.MODIFIER: "modifier",
    HookKind.POLICY: "policy",
    HookKind.CREATOR: "creator",
}
_IN_PLANS = (HookKind.ACTION, HookKind.EVALUATOR)
"""What missions files name."""


def hook_added(one: Declared) -> Change:
    """There is a function more to write."""
    kind = kind_of(one)
    use = {
        HookKind.ACTION: "trips can now have the action",
        HookKind.EVALUATOR: "missions can now be judged by the evaluator",
    }.get(kind, f"there is now the {_WORDS[kind]}")
    return told(
        "hook_added",
        f"{use} `{one.name}`, which must be written in hooks.py",
        (None, one.name),
        now=one.span,
    )


def hook_removed(one: Declared) -> Change:
    """There is a function less to write."""
    kind = kind_of(one)
    refused = ": missions files that name it are refused" if kind in _IN_PLANS else ""
    return told(
        "hook_removed",
        f"there is no {_WORDS[kind]} `{one.name}` any more{refused}",
        (one.name, None),
        was=one.span,
    )


def hook_renamed(old: Declared, new: Declared) -> Change:
    """A function has another name."""
    kind = kind_of(new)
    files = "hooks.py and missions files" if kind in _IN_PLANS else "hooks.py"
    return told(
        "hook_renamed",
        f"the {_WORDS[kind]} `{old.name}` is now `{new.name}`, declared alike: {files} must say"
        " so, too",
        (old.name, new.name),
        old.span,
        new.span,
    )


def repeat_changed(old: Action, new: Action) -> Change:
    """What was begun when the ground station broke down is done once more, or not."""
    again = new.repeat == "safe"
    fate = "it is done once more" if again else "it waits for a person to decide"
    return told(
        "repeat_changed",
        f"the action `{new.name}` is now `{new.repeat}`, and before it was `{old.repeat}`:"
        f" after a breakdown in the middle of it, {fate}",
        (old.repeat, new.repeat),
        old.span,
        new.span,
        Importance.SAFETY,
    )


def returns_changed(old: Action, new: Action) -> Change:
    """What an action gives is of another type, or of one that is declared."""
    now = f"gives {_given(new)}" if new.returns else "may give anything"
    before = f"it gave {_given(old)}" if old.returns else "it could give anything"
    sentence = f"the action `{new.name}` now {now}; before, {before}"
    return told("returns_changed", sentence, (old.returns, new.returns), old.span, new.span)


def takes_changed(old: Action, new: Action) -> Change:
    """Plans reckon with another duration of an action, so that drones are given other trips."""
    sentence = f"plans now reckon with {_taken(new)} for the action `{new.name}`; before, with {_taken(old)}"
    return told("takes_changed", sentence, (old.takes, new.takes), old.span, new.span)


def _taken(one: Action) -> str:
    if one.takes is None:
        return f"{amount(RECKONED, Type.TIME)} (the app does not say)"
    return f"its `{one.takes}`" if isinstance(one.takes, str) else amount(one.takes, Type.TIME)


def _given(one: Action) -> str:
    return f"values of the type {one.returns}"


def parameter_added(old: Declared, new: Declared, one: Parameter) -> Change:
    """A hook takes a value more."""
    if kind_of(new) is not HookKind.ACTION:
        sentence = f"{_hook(new)} now takes `{one.name}` ({one.type.value}), in hooks.py, too"
    elif one.default is None:
        sentence = f"a trip with {_hook(new)} must now name its `{one.name}` ({one.type.value})"
    else:
        without = amount(one.default, one.type)
        sentence = (
            f"a trip with {_hook(new)} can now name its `{one.name}` ({one.type.value});"
            f" where it names none, it is {without}"
        )
    return told("parameter_added", sentence, (None, one.name), old.span, new.span)


def parameter_removed(old: Declared, new: Declared, one: Parameter) -> Change:
    """A hook takes a value less."""
    if kind_of(new) is HookKind.ACTION:
        sentence = (
            f"a trip with {_hook(new)} can no longer name its `{one.name}`:"
            " missions files with it are refused"
        )
    else:
        sentence = f"{_hook(new)} no longer takes `{one.name}`, in hooks.py, too"
    return told("parameter_removed", sentence, (one.name, None), old.span, new.span)


def type_changed(old: Declared, new: Declared, was: Parameter, now: Parameter) -> Change:
    """A value that a hook takes is of another type."""
    sentence = (
        f"`{now.name}` of {_hook(new)} is now of the type {now.type.value};"
        f" before, {was.type.value}"
    )
    return told("type_changed", sentence, (was.type.value, now.type.value), old.span, new.span)


def default_changed(old: Declared, new: Declared, was: Parameter, now: Parameter) -> Change:
    """A value that a trip need not name is another one, or must be named."""
    if kind_of(new) is not HookKind.ACTION:
        sentence = (
            f"where a mission chooses {_hook(new)}, its `{now.name}` is now"
            f" {amount(now.default, now.type)}; before, {amount(was.default, was.type)}"
        )
        return told("default_changed", sentence, (was.default, now.default), old.span, new.span)
    before = "it had to name one" if was.default is None else amount(was.default, was.type)
    if now.default is None:
        sentence = f"a trip with {_hook(new)} must now name its `{now.name}`; before, {before}"
        sentence += " where it named none" if was.default is not None else ""
    else:
        after = amount(now.default, now.type)
        sentence = (
            f"where a trip with {_hook(new)} names no `{now.name}`, it is now {after};"
            f" before, {before}"
        )
    return told("default_changed", sentence, (was.default, now.default), old.span, new.span)


def emits_changed(old: Hook, new: Hook) -> Change:
    """A hook may say other statuses."""
    was = tuple(status.value for status in old.emits)
    now = tuple(status.value for status in new.emits)
    more, less = [s for s in now if s not in was], [s for s in was if s not in now]
    if not was:
        said = f"now decides with which status a mission goes on: {listed(now, 'or')}"
    elif not now:
        said = "no longer decides with which status a mission goes on"
    else:
        said = ", and ".join(
            [f"can now say {listed(more, 'or')}"] * bool(more)
            + [f"can no longer say {listed(less, 'or')}"] * bool(less)
        )
    sentence = f"{_hook(new)} {said}"
    return told("emits_changed", sentence, (was, now), old.span, new.span, Importance.MISSIONS)


def writes_changed(old: Hook, new: Hook) -> Change:
    """A hook changes other attributes of the mission."""
    now = f"changes {named(new.writes)}" if new.writes else "changes nothing"
    was = f"it changed {named(old.writes)}" if old.writes else "it changed nothing"
    sentence = f"{_hook(new)} now {now} of a mission; before, {was}"
    return told("writes_changed", sentence, (old.writes, new.writes), old.span, new.span)


def _hook(one: Declared) -> str:
    return f"the {_WORDS[kind_of(one)]} `{one.name}`"
