"""Validating the declaration of a block, field by field.

A declaration may be another author's code: what is wrong with it is said here, with the package's name and
the block's, and not met later as a mistake of the compiler.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from keyword import iskeyword
from sys import float_info
from typing import Any

from plutoc.block import (
    AnyParam,
    Block,
    Choice,
    EventParam,
    Gate,
    Given,
    HookKind,
    HookParam,
    Narrowed,
    Param,
)
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status
from plutoc_runtime.domain.text import bounded, printable, shown

_FLAGS = (
    "emits_by_hook",
    "named",
    "creates",
    "holds",
    "allocates",
    "launches",
    "watches",
    "limits",
    "interrupts",
    "evaluates",
    "repeats",
    "retries",
    "skips",
)


def mistakes_in(block: Block) -> Iterator[str]:
    """Yield what is wrong with a block's declaration."""
    if not is_name(block.name):
        yield f"its `name` must be a name as Python has them, not {_called(block.name)}"
    if not is_text(block.doc):
        yield f"its `doc` must be a text that can be shown, not {_called(block.doc)}"
    yield from _function("step", block.step)
    if block.limit is not None:
        yield from _function("limit", block.limit)
    for field in ("transitions", "guarded"):
        yield from _transitions(field, getattr(block, field))
    yield from _all("params", block.params, (Param, HookParam, Choice, EventParam), _param)
    yield from _all("given", block.given, (Given,), _given)
    for one in block.given if type(block.given) is tuple else ():
        functions = [one.step, *([one.limit] if one.limit is not None else [])]
        for function in functions if type(one) is Given else ():
            yield from _function("given", function)
    yield from _all("narrowed", block.narrowed, (Narrowed,), _narrowed)
    yield from _all("needs", block.needs, (Field,), _field)
    for field in ("reads", "uses"):
        yield from _all(field, getattr(block, field), (str,), _name)
    for field in _FLAGS:
        if type(getattr(block, field)) is not bool:
            yield f"its `{field}` must be True or False, not {_called(getattr(block, field))}"
    if block.bound is not None and not is_name(block.bound):
        yield f"its `bound` must be a parameter's name, not {_called(block.bound)}"
    if block.gate is not None and type(block.gate) is not Gate:
        yield f"its `gate` must be a Gate, not {_called(block.gate)}"


def is_name(text: object) -> bool:
    """Return whether this can be a name in a source, and in Python."""
    return type(text) is str and text.isascii() and text.isidentifier() and not iskeyword(text)


def is_text(text: object) -> bool:
    """Return whether this can be printed, without control characters."""
    return type(text) is str and all(char.isprintable() or char in "\n\t" for char in text)


def _called(value: object) -> str:
    return bounded(printable(shown(value)), 60)


def _function(field: str, given: object) -> Iterator[str]:
    """A package gets the module in which it stands, and calls it there by its name."""
    name, module = getattr(given, "__name__", None), getattr(given, "__module__", None)
    if not callable(given) or type(name) is not str or type(module) is not str:
        yield f"its `{field}` must be a function, not {_called(given)}"
    elif not is_name(name) or getattr(sys.modules.get(module), name, None) is not given:
        yield (
            f"its `{field}` must be a function that its module has under its own name, and"
            f" {_called(module)} has no such {_called(name)}: write it with def, at the module's top"
        )


def _transitions(field: str, given: object) -> Iterator[str]:
    if not isinstance(given, Mapping):
        yield f"its `{field}` must be a mapping of statuses to sets of them, not {_called(given)}"
        return
    for status, emitted in given.items():
        is_set = isinstance(emitted, (frozenset, set))
        if not is_set or any(type(one) is not Status for one in (status, *emitted)):
            said = f"{_called(status)}: {_called(emitted)}"
            yield f"its `{field}` must give a set of statuses for each status, not {said}"


def _all(
    field: str, given: object, types: tuple[type, ...], wrong: Callable[[Any], str | None]
) -> Iterator[str]:
    if type(given) is not tuple:
        yield f"its `{field}` must be a tuple, not {_called(given)}"
        return
    for one in given:
        if not isinstance(one, types):
            names = " or ".join(kind.__name__ for kind in types)
            yield f"its `{field}` holds {_called(one)}, which is no {names}"
        elif said := wrong(one):
            yield f"its `{field}` {said}"


def _name(one: str) -> str | None:
    return None if is_name(one) else f"holds {_called(one)}, which is no name"


def _param(one: AnyParam) -> str | None:
    if not is_name(one.name) or one.name in _GIVEN:
        return f"holds a parameter whose name is {_called(one.name)}"
    if not is_text(one.doc):
        return f"has no text that can be shown as the `doc` of {one.name}"
    if isinstance(one, Param):
        right = type(one.type) is Type and _is_plain(one.default) and _is_plain(one.least)
    elif isinstance(one, HookParam):
        right = type(one.kind) is HookKind and (one.instead == "" or is_name(one.instead))
    elif isinstance(one, EventParam):
        right = type(one.required) is bool
    else:
        options = isinstance(one.options, Mapping) and all(map(is_name, one.options))
        right = options and one.default in one.options and type(one.hook) in _HOOKS
        functions = (*one.options.values(), one.adapt or one.options[one.default]) if right else ()
        if any(True for given in functions for _ in _function("options", given)):
            return (
                f"has a parameter {one.name} with a function that its module has not under its name"
            )
    return None if right else f"has a parameter {one.name} whose facts are not of their types"


_GIVEN = ("run", "status")
"""What each step gets besides, by these names."""

_HOOKS = (type(None), HookKind)


def _is_plain(value: object) -> bool:
    """Return whether this can be written into a package: a number that is one, or a text."""
    match value:
        case str():
            return is_text(value)
        case int() | float():
            return type(value) in (int, float, bool) and abs(value) <= float_info.max
    return value is None


def _given(one: Given) -> str | None:
    return None if is_name(one.param) else f"holds {_called(one)}"


def _narrowed(one: Narrowed) -> str | None:
    statuses = isinstance(one.emits, (frozenset, set)) and not {type(s) for s in one.emits} - {
        Status
    }
    return None if is_name(one.param) and statuses else f"holds {_called(one)}"


def _field(one: Field) -> str | None:
    if not is_name(one.name) or one.name in _GIVEN:
        return f"holds a field whose name is {_called(one.name)}"
    texts = is_text(one.label) and is_text(one.doc)
    kinds = type(one.on) is Entity and type(one.type) is FieldType
    if texts and kinds and _is_plain(one.default):
        return None
    return f"has a field {one.name} whose facts are not of their types"
