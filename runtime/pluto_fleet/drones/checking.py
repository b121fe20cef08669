"""What is wrong with a class that is to fly drones, found by looking at it: nothing of it is called.

Types are not looked at, mypy does that. What is found here would otherwise be found in the air.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator

from . import refusals
from .kinds import Kind, Method, Shape

_NOTHING = object()


def problems(kind: Kind, made: type) -> list[str]:
    """Return all that is wrong with a class of this kind."""
    found: list[str] = []
    if not _takes(made, [kind.argument]):
        found.append(refusals.not_made_of(kind.argument))
    for method in kind.methods:
        found += _of_method(made, method)
    for group in kind.together:
        there = [method for method in group if _attribute(made, method) is not _NOTHING]
        for method in group if there else ():
            if method in there:
                found += _of_method(made, method)
            else:
                found.append(refusals.half(method.name, there[0].name))
    return found


def _of_method(made: type, method: Method) -> Iterator[str]:
    attribute = _attribute(made, method)
    if method.shape is Shape.PROPERTY:
        if inspect.isroutine(attribute):  # none at all may be set when an object is made
            yield refusals.no_property()
        return
    if attribute is _NOTHING:
        yield refusals.no_method(method.name)
        return
    if not callable(attribute):
        yield refusals.not_callable(method.name)
        return
    written = inspect.unwrap(attribute)
    waits, iterates = inspect.iscoroutinefunction(written), inspect.isasyncgenfunction(written)
    if method.shape is Shape.WAITS and not waits:
        yield refusals.not_async(method.name)
    elif method.shape is Shape.AT_ONCE and (waits or iterates):
        yield refusals.is_async(method.name)
    elif method.shape is Shape.ITERATES and waits:
        yield refusals.no_iterator(method.name)
    elif method.of_class and not _stands_alone(made, method):
        yield refusals.not_static(method.name)
    elif not _takes(attribute, _arguments(made, method)):
        yield refusals.not_taken(method.name, method.takes)


def _attribute(made: type, method: Method) -> object:
    return getattr(made, method.name, _NOTHING)


def _arguments(made: type, method: Method) -> list[str]:
    """Return what it is called with, looked up on the class: the object itself is one of it."""
    return [*([] if _stands_alone(made, method) else ["self"]), *method.takes]


def _stands_alone(made: type, method: Method) -> bool:
    """Say whether a method needs no object."""
    return isinstance(inspect.getattr_static(made, method.name), (staticmethod, classmethod))


def _takes(called: object, arguments: list[str]) -> bool:
    """Say whether something can be called with so many arguments; unknown counts as yes."""
    if not callable(called):
        return False
    try:
        signature = inspect.signature(called)
    except (TypeError, ValueError):  # written in another language than Python
        return True
    try:
        signature.bind(*arguments)
    except TypeError:
        return False
    return True
