"""Writing values, texts, annotations and imports as Python."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from plutoc.graph.hooks import PHOTO
from plutoc.graph.model import Plain
from plutoc_runtime.domain.quantities import QUANTITIES, Type
from plutoc_runtime.domain.status import Status

LINE_LENGTH = 100

PYTHON: dict[Type, str] = {
    Type.INT: "int",
    Type.BOOL: "bool",
    Type.TEXT: "str",
    **dict.fromkeys((Type.FLOAT, *QUANTITIES), "float"),
}
"""The Python type that a hook gets for each type of the language."""

UNITS = {
    Type.MASS: "in kilograms",
    Type.LENGTH: "in metres",
    Type.TIME: "in seconds",
    Type.ANGLE: "in radians",
    Type.PERCENT: "a share from 0 to 1",
    Type.SPEED: "in metres a second",
    Type.TEMPERATURE: "in kelvin",
}
"""How a hook gets a quantity, in words."""

_PLAIN_DOC = re.compile(r'[^\x00-\x1f\x7f"\\]+')
_BUILTIN = re.compile(r"\b(int|float|bool|str|object)\b")


def python_result(name: str) -> str:
    """Return the Python type of what an action gives, by its name in the language."""
    return "Photo" if name == PHOTO else PYTHON[Type(name)]


def literal(value: Plain | None) -> str:
    """Return a value as Python writes it; a text in ASCII."""
    return ascii(value)


def items(values: Iterable[str], brackets: str = "()") -> str:
    """Return a tuple, or with other brackets a list or a set, of what is written already."""
    written = tuple(values)
    single = "," if brackets == "()" and len(written) == 1 else ""
    return f"{brackets[0]}{', '.join(written)}{single}{brackets[1]}"


def call(function: str, arguments: Iterable[str]) -> str:
    """Return a call with arguments that are written already."""
    return f"{function}({', '.join(arguments)})"


def docstring(text: str) -> str:
    """Return a docstring of what a package of blocks says about itself."""
    plain = _PLAIN_DOC.fullmatch(text) is not None
    return f'"""{text}"""' if plain else ascii(text)


def builtins_alias(taken: Collection[str]) -> str:
    """Return by what name a module has `builtins` where these names are the user's."""
    return "_builtins" if "builtins" in taken else "builtins"


def annotation(type_name: str, taken: Collection[str]) -> str:
    """Return a type, spelled so that it stays right where these names are the user's."""

    def spelled(match: re.Match[str]) -> str:
        return f"{builtins_alias(taken)}.{match[0]}" if match[0] in taken else match[0]

    return _BUILTIN.sub(spelled, type_name)


def shadows(taken: Collection[str], type_names: Iterable[str]) -> bool:
    """Return whether one of these types would be hidden by one of these names."""
    return any(annotation(name, taken) != name for name in type_names)


def status_tuple(statuses: tuple[Status, ...]) -> str:
    """Return some statuses as Python writes them."""
    return items(f"Status.{status.name}" for status in statuses)


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
