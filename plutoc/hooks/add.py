"""`--add-stubs`: a hooks.py with stubs for what is missing at its end."""

from __future__ import annotations

import ast
import re

from plutoc.check.model import Checked
from plutoc.emit.hooks_file import stub
from plutoc.emit.stubs import stubs
from plutoc.hooks.check import missing
from plutoc.hooks.module import read
from plutoc.hooks.python import parsed
from plutoc.source import Source

_BUILTINS = re.compile(r"\b(_?builtins)\.")


def with_stubs(checked: Checked, hooks: Source, *, only: str | None = None) -> str:
    """Return the file's text with a stub for each hook that it does not define, or for one.

    What stands there stays as it is; only imports that the stubs need come in.
    """
    names = tuple(name for name in missing(checked, hooks) if only in (None, name))
    if not names:
        return hooks.text
    parts = [_with_imports(checked, hooks, names).rstrip("\n")]
    parts += [stub(checked, name).rstrip("\n") for name in names]
    return "\n\n\n".join(part for part in parts if part) + "\n"


def _with_imports(checked: Checked, hooks: Source, names: tuple[str, ...]) -> str:
    lines = _import_lines(checked, hooks, names)
    if not lines:
        return hooks.text
    text = hooks.text.split("\n")
    after = _last_import(hooks)
    if after == 0:  # neither docstring nor imports
        return "\n".join([*lines, "", *text])
    return "\n".join([*text[:after], *lines, *text[after:]])


def _import_lines(checked: Checked, hooks: Source, names: tuple[str, ...]) -> list[str]:
    """Return imports of what the stubs name and the file does not."""
    wanted = [one for one in stubs(checked) if one.name in names]
    uses = {use for one in wanted for use in one.uses}
    lines = []
    aliases = {match[1] for one in wanted for match in _BUILTINS.finditer(one.signature)}
    defined = read(hooks).defined
    for alias in sorted(aliases - defined.keys()):
        lines.append("import builtins" + ("" if alias == "builtins" else f" as {alias}"))
    if "Sequence" in uses - defined.keys():
        lines.append("from collections.abc import Sequence")
    own = sorted(uses - defined.keys() - {"Sequence"})
    if own:
        lines.append(f"from . import {', '.join(own)}")
    return lines


def _last_import(hooks: Source) -> int:
    """Return how many lines come before the code: a docstring and imports."""
    last = 0
    for statement in parsed(hooks).body:
        docstring = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
        if not docstring and not isinstance(statement, ast.Import | ast.ImportFrom):
            break
        last = statement.end_lineno or last
    return last
