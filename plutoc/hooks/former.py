"""What a hooks.py keeps of hooks that the app does not declare any more."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from plutoc.check.model import Checked
from plutoc.diagnostic import Diagnostic
from plutoc.emit.lock import PROBE, hooks_of
from plutoc.hooks import errors
from plutoc.hooks.module import Function, name_span, read
from plutoc.hooks.python import parsed
from plutoc.source import Source

_PROBE_OF = "{}_done"


def left_over(
    checked: Checked, hooks: Source, known: Mapping[str, str]
) -> tuple[dict[str, str], tuple[Diagnostic, ...]]:
    """Return those of the known hooks that are still defined, and not declared; warn of them.

    A function that was never a hook is the developer's own, and so is one that the file itself
    uses: of these nothing is said.
    """
    gone = _gone(hooks_of(checked.graph), known)
    if not gone:
        return {}, ()
    module, used = read(hooks), _used(hooks)
    former: dict[str, str] = {}
    warnings: list[Diagnostic] = []
    for name, kind in gone.items():
        definition = module.defined.get(name)
        if isinstance(definition, Function):
            former[name] = kind
            if name not in used:
                span, app = name_span(hooks, definition), checked.graph.source
                warnings.append(errors.left_over(app, hooks, span, name, kind))
    return former, tuple(warnings)


def _gone(declared: Mapping[str, str], known: Mapping[str, str]) -> dict[str, str]:
    """Return the known hooks that are not declared, with what told whether they were done."""
    return {
        name: kind
        for name, kind in {**_probes(known), **known}.items()
        if name not in declared and name not in _probes(declared)
    }


def _probes(hooks: Mapping[str, str]) -> dict[str, str]:
    return {_PROBE_OF.format(name): PROBE for name, kind in hooks.items() if kind == "action"}


def _used(hooks: Source) -> set[str]:
    """Return the names that a file uses; what a function does with its own name is no use of it.

    Texts in tables of the module count, such as those of `__all__`.
    """
    used = set[str]()
    for statement in parsed(hooks).body:
        own = statement.name if isinstance(statement, Function) else None
        names = set[str]()
        for node in ast.walk(statement):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
                names.add(node.id)
            elif own is None and isinstance(node, ast.Constant) and isinstance(node.value, str):
                names.add(node.value)
        used |= names - {own}
    return used
