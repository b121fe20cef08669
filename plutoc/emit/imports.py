"""The import lines of a generated module, in the order that isort gives them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Import:
    """`from module import name [as alias]`; without a name, `import module [as alias]`."""

    module: str
    name: str | None = None
    alias: str | None = None


def names(module: str, *wanted: str) -> tuple[Import, ...]:
    """Return the imports of some names of one module."""
    return tuple(Import(module=module, name=name) for name in wanted)


def import_lines(imports: Iterable[Import]) -> list[str]:
    """Return one line a module, the standard library's apart from the package's own."""
    unique = tuple(dict.fromkeys(imports))
    standard = [one for one in unique if not one.module.startswith(".")]
    own = [one for one in unique if one.module.startswith(".")]
    lines = _lines(standard)
    if standard and own:
        lines.append("")
    return lines + _lines(own)


def _lines(imports: list[Import]) -> list[str]:
    whole = [one for one in imports if one.name is None]
    lines = [f"import {one.module}{_as(one)}" for one in sorted(whole, key=lambda one: one.module)]
    for module in sorted({one.module for one in imports if one.name is not None}):
        from_it = [one for one in imports if one.module == module and one.name is not None]
        plain = sorted((one.name or "" for one in from_it if one.alias is None), key=_rank)
        if plain:
            lines.append(f"from {module} import {', '.join(plain)}")
        aliased = sorted(
            (one for one in from_it if one.alias), key=lambda one: (_rank(one.name or ""), _as(one))
        )
        lines += [f"from {module} import {one.name}{_as(one)}" for one in aliased]
    return lines


def _as(one: Import) -> str:
    return f" as {one.alias}" if one.alias else ""


def _rank(name: str) -> tuple[int, str]:
    """Constants come first, then classes, then functions."""
    if name.isupper() and len(name) > 1:
        return 0, name
    return (1 if name[:1].isupper() else 2), name
