"""Comparing the fields that the apps declare for their missions and trips."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.diff.blocks import same
from plutoc.diff.both import Both
from plutoc.diff.messages import own_fields as messages
from plutoc.diff.model import Change
from plutoc.graph.model import AppField


def own_fields(both: Both) -> Iterator[Change]:
    """Compare them by name; one that is gone may be there under another, declared alike."""
    old = {(one.on, one.name): one for one in both.old.graph.fields}
    new = {(one.on, one.name): one for one in both.new.graph.fields}
    gone = [one for key, one in old.items() if key not in new]
    come = [one for key, one in new.items() if key not in old]
    for key, now in new.items():
        was = old.get(key)
        if was is not None and was.type is not now.type:
            yield messages.field_type_changed(was, now)
        elif was is not None and not same(was.default, now.default):
            yield messages.field_default_changed(was, now)
    renamed = _renamed(gone, come)
    yield from (messages.field_renamed(was, now) for was, now in renamed)
    yield from (messages.field_added(one) for one in come if one not in [n for _, n in renamed])
    yield from (messages.field_removed(one) for one in gone if one not in [o for o, _ in renamed])


def _renamed(gone: Sequence[AppField], come: Sequence[AppField]) -> list[tuple[AppField, AppField]]:
    found: list[tuple[AppField, AppField]] = []
    left = list(come)
    for was in gone:
        alike = next((now for now in left if _is_alike(was, now)), None)
        if alike is not None:
            left.remove(alike)
            found.append((was, alike))
    return found


def _is_alike(one: AppField, other: AppField) -> bool:
    return (one.on, one.type) == (other.on, other.type) and same(one.default, other.default)
