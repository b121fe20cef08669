"""What is said of the fields that an app declares for its missions and trips."""

from __future__ import annotations

from plutoc.diff.messages.declared import told
from plutoc.diff.model import Change
from plutoc.diff.phrases import amount
from plutoc.graph.model import AppField


def field_added(one: AppField) -> Change:
    """There is something more to enter."""
    if one.default is None:
        sentence = f"a {one.on.value} must now have `{one.name}` ({one.type.value})"
        sentence += ", in missions files"
    else:
        sentence = f"a {one.on.value} can now have `{one.name}` ({one.type.value})"
        sentence += f", in missions files; where it has none, it is {_default(one)}"
    return told("field_added", sentence, (None, one.name), now=one.span)


def field_removed(one: AppField) -> Change:
    """There is something less to enter."""
    sentence = (
        f"a {one.on.value} can no longer have `{one.name}`: missions files with it are refused, and"
        " hooks cannot read it"
    )
    return told("field_removed", sentence, (one.name, None), was=one.span)


def field_renamed(old: AppField, new: AppField) -> Change:
    """A field has another name."""
    sentence = (
        f"`{old.name}` of {new.on.value}s is now `{new.name}`, declared alike: missions files and"
        " hooks.py must say so, too"
    )
    return told("field_renamed", sentence, (old.name, new.name), old.span, new.span)


def field_type_changed(old: AppField, new: AppField) -> Change:
    """A field holds something else."""
    sentence = (
        f"`{new.name}` of {new.on.value}s is now of the type {new.type.value};"
        f" before, {old.type.value}"
    )
    facts = (old.type.value, new.type.value)
    return told("field_type_changed", sentence, facts, old.span, new.span)


def field_default_changed(old: AppField, new: AppField) -> Change:
    """What a field is where it is left out is something else, or it must not be left out."""
    on = new.on.value
    if new.default is None:
        sentence = (
            f"a {on} must now have `{new.name}`; before, it was {_default(old)} where it had none"
        )
    else:
        before = "it had to have one" if old.default is None else _default(old)
        sentence = f"where a {on} has no `{new.name}`, it is now {_default(new)}; before, {before}"
    facts = (old.default, new.default)
    return told("field_default_changed", sentence, facts, old.span, new.span)


def _default(one: AppField) -> str:
    return amount(one.default, one.type)
