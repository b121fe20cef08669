"""The typed calls of the Python client, one for each address."""

from __future__ import annotations

import typing
from collections.abc import Iterator, Sequence
from types import NoneType, UnionType
from typing import Any, Literal, NotRequired, get_args, get_origin, get_type_hints

from pluto_fleet.station import requests, wire, wire_app
from pluto_fleet.station.requests import Said
from pluto_fleet.station.web.addresses import ADDRESSES, Address
from pluto_fleet.station.web.reads import TOML
from pluto_fleet.station.web.results import GEOJSON

from .formatted import formatted

_HEAD = '''"""Every address of a station as a method; made by `python -m station_interface`."""

from __future__ import annotations

from typing import {typing}

{imports}
from .connection import Connection


class Calls(Connection):
    """What can be asked of a station."""
'''


def calls(addresses: Sequence[Address] = ADDRESSES) -> str:
    """Return the module."""
    methods = "".join(_method(address) for address in addresses)
    code = "\n".join(line for line in methods.splitlines() if '"""' not in line)
    imports = [
        f"from ..station.{module.__name__.rpartition('.')[2]} import {', '.join(names)}"
        for module in (requests, wire, wire_app)
        if (names := [name for name in _own(module) if _is_named(name, code)])
    ]
    typing = ", ".join(name for name in ("Any", "Literal") if _is_named(name, code))
    head = _HEAD.format(imports="\n".join(imports), typing=typing)
    return formatted(head + methods)


def _own(module: Any) -> Iterator[str]:
    """Yield the names of the types that a module declares, in order."""
    return (
        name
        for name, one in sorted(vars(module).items())
        if isinstance(one, type) and one.__module__ == module.__name__
    )


def _is_named(name: str, code: str) -> bool:
    return any(f"{before}{name}{after}" in code for before in " [" for after in "[]:, ")


def _method(address: Address) -> str:
    parameters, body = [], ""
    query = ", ".join(f'"{name}": {name}' for name in address.query)
    query = f"{{{query}}}"
    takes = []
    if isinstance(address.body, tuple):
        parameters.append("body: str | bytes")
        takes += ["media: str"] if len(address.body) > 1 else []
    for name, one in address.query.items():
        kind = one.type.__name__
        takes.append(f"{name}: {kind}" + ("" if one.needed else f" = {one.type()!r}"))
    if address.body is not None and not isinstance(address.body, tuple):
        needed, optional = _arguments(address.body)
        takes += [*needed, *optional]
        body = ", ".join(
            f'"{name}": {name}' for name in get_type_hints(address.body) if name != "id"
        )
        body = f"{{{body}}}"
    parameters += ["*", *takes] if takes else []
    signature = f"def {address.name}({', '.join(['self', *parameters])}) -> {_answer(address)}:"
    return (
        f'\n    {signature}\n        """{address.says}"""\n        {_call(address, query, body)}\n'
    )


def _arguments(body: Any) -> tuple[list[str], list[str]]:
    needed, optional = [], []
    for name, hint in get_type_hints(body, include_extras=True).items():
        if name == "id":
            optional.append("id: str | None = None")
        elif get_origin(hint) is NotRequired:
            kind = _written(get_args(hint)[0])
            optional.append(f"{name}: {kind if 'None' in kind else f'{kind} | None'} = None")
        else:
            needed.append(f"{name}: {_written(hint)}")
    return needed, optional


def _answer(address: Address) -> str:
    if isinstance(address.answers, str):
        return "str" if address.answers.startswith(("text/", TOML, GEOJSON)) else "bytes"
    if address.answers is Said:
        return "str"
    return _written(address.answers)


def _call(address: Address, query: str, body: str) -> str:
    where = f'"{address.method}", "{address.path}"'
    if isinstance(address.answers, str):
        asked = f"{where}, {query}" if address.query else where
        return f"return self._{'text' if _answer(address) == 'str' else 'bytes'}({asked})"
    if address.answers is Said:
        return f'return self._command("{address.path}", id, {body})'
    if isinstance(address.body, tuple):
        media = "media" if len(address.body) > 1 else f'"{address.body[0]}"'
        call = f"self._sent({where}, {query}, body, {media}, wanted={_answer(address)})"
    else:
        sent = [f"query={query}"] if address.query else []
        sent += [f"body={body}"] if body else []
        sent.append(f"wanted={_answer(address)}")
        call = f"self._json({', '.join([where, *sent])})"
    return f"answer: {_answer(address)} = {call}\n        return answer"


def _written(kind: Any) -> str:
    """Return a type as it is written."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in (typing.Union, UnionType):
        return " | ".join(map(_written, arguments))
    if origin is Literal:
        return f"Literal[{', '.join(map(repr, arguments))}]"
    if origin is not None:
        return f"{origin.__name__}[{', '.join(map(_written, arguments))}]"
    return "None" if kind is NoneType else str(kind.__name__)
