"""One address of a station, as a typed method says it: what is sent, how that is checked, what is answered.

The server decodes requests by these, the client makes them, and `python -m station_interface` describes them.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, reduce, wraps
from operator import or_
from types import UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    TypeVar,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

import msgspec
from msgspec import UNSET, Meta, UnsetType, ValidationError

from ..shared.domain.errors import BadInput
from .wire import Role, Said

JSON = "application/json"
SMALL_BODY = 1024 * 1024
"""The most bytes of a body, where an address does not say that it takes more."""
LARGE_BODY = 20 * 1024 * 1024
LARGEST = 2**53
"""The largest whole number that is exact in a browser."""
_DEPTH = 8
"""How deep lists and objects may lie in each other in what is checked by what takes it, as a plan."""

Whole = Annotated[int, Meta(ge=-LARGEST, le=LARGEST)]
CommandId = Annotated[
    str,
    Meta(min_length=1, max_length=64, description="Sent again with it, a command is done once."),
]
F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True, kw_only=True)
class Operation:
    """What can be asked at one address under one method."""

    method: Literal["GET", "POST", "PUT", "DELETE"]
    path: str
    name: str
    says: str
    answers: Any
    """The type of an answer in JSON."""
    media: str = JSON
    """The media type of the answer."""
    role: Role = "fly"
    in_path: tuple[str, ...] = ()
    """The names that stand in the path, each in braces."""
    query: Mapping[str, Any]
    body: Mapping[str, Any] | None
    """The types of the fields of a body in JSON; None: it has none."""
    takes: tuple[str, ...] = ()
    """The media types of a body that is not JSON."""
    defaults: Mapping[str, Any]
    """What is supposed of what is left out; what is not in here is needed."""
    most_bytes: int = SMALL_BODY
    impossible: int = 409
    """The status of the answer where what is asked cannot be done."""
    stale: Any = None
    """The type of the answer 409 to an edit of what has changed meanwhile, if not a sentence."""
    reads: bool = False
    """Whether it changes nothing, and so stands in no audit."""
    reads_flights: bool = False
    """Whether it reads files of flights, which may take a while."""
    always: bool = False
    """Whether it brings drones down, and so is exempt from all limits."""

    @property
    def is_command(self) -> bool:
        """Whether it is answered with a sentence, and done once for each id."""
        return self.answers is Said

    def asked(self, query: Mapping[str, str]) -> dict[str, Any]:
        """Return the parameters in an address; raise `BadInput` where they are wrong or missing."""
        numbers = [name for name, one in self.defaults.items() if isinstance(one, int | float)]
        given = {name: text for name, text in query.items() if text or name not in numbers}
        return self._checked(lambda: msgspec.convert(given, self._query, strict=False))

    def sent(self, body: bytes) -> dict[str, Any]:
        """Return the fields of a body in JSON; raise `BadInput` where they are wrong or missing."""
        return self._checked(lambda: self._body.decode(body))

    @cached_property
    def _query(self) -> type[msgspec.Struct]:
        return self._struct(self.query, strict=False)

    @cached_property
    def _body(self) -> msgspec.json.Decoder[msgspec.Struct]:
        return msgspec.json.Decoder(self._struct(self.body or {}, strict=True))

    def _struct(self, kinds: Mapping[str, Any], *, strict: bool) -> type[msgspec.Struct]:
        fields = [
            (
                (name, _decoded(kind) | UnsetType, UNSET)
                if name in self.defaults
                else (name, _decoded(kind))
            )
            for name, kind in kinds.items()
        ]
        return msgspec.defstruct(self.name, fields, kw_only=True, forbid_unknown_fields=strict)

    def _checked(self, decode: Callable[[], msgspec.Struct]) -> dict[str, Any]:
        try:
            found = msgspec.structs.asdict(decode())
        except ValidationError as error:
            raise BadInput(in_words(str(error), {**self.query, **(self.body or {})})) from None
        except (msgspec.DecodeError, RecursionError) as error:
            why = str(error).removeprefix("JSON is malformed: ")
            raise BadInput(f"what was sent is not JSON: {why}") from None
        return {name: value for name, value in found.items() if value is not UNSET}


def _plain(depth: int) -> Any:
    """Return the type of plain data, which is neither deep nor has numbers that a browser cannot have."""
    kind: Any = Whole | float | str | bool | None
    for _ in range(depth):
        kind = Whole | float | str | bool | list[kind] | dict[str, kind] | None
    return kind


_PLAIN = _plain(_DEPTH)
_OBJECT: Any = dict[str, _PLAIN]  # type: ignore[valid-type]


def _decoded(kind: Any) -> Any:
    """Return as what a value is decoded: of objects plain data, as what takes them says what is wrong in them."""
    if kind is int:
        return Whole
    if kind is Any:
        return _PLAIN
    if is_typeddict(kind) or get_origin(kind) is dict:
        return _OBJECT
    if get_origin(kind) is list:
        return list[_decoded(get_args(kind)[0])]  # type: ignore[misc]
    if isinstance(kind, UnionType):
        return reduce(or_, map(_decoded, get_args(kind)))
    return kind


_WORDS = {
    "str": "a text",
    "int": "a whole number",
    "float": "a number",
    "bool": "true or false",
    "array": "a list",
    "object": "an object",
}
_SAID = re.compile(r"(?P<what>.*?)(?: - at (?:`key` in )?`\$\.?(?P<where>.*)`)?", re.DOTALL)


def in_words(error: str, fields: Mapping[str, Any]) -> str:
    """Return what msgspec finds wrong with data as a sentence for people, which names the place."""
    found = _SAID.fullmatch(error)
    assert found is not None
    what = found["what"]
    where = found["where"] or "what was sent"
    if match := re.fullmatch(r"Expected (.*?)(?:, got .*)?", what):
        return f"{where} must be {_named(match[1])}"
    if match := re.fullmatch(r"Object missing required field `(.*)`", what):
        return f"{where} has no {match[1]}"
    if match := re.fullmatch(r"Object contains unknown field `(.*)`", what):
        return f'{where} has an unknown key "{match[1][:40]}"; it may have: {", ".join(fields)}'
    if what.startswith("Invalid enum value"):
        some = " or ".join(f'"{one}"' for one in _choices(fields.get(where.rpartition(": ")[2])))
        return f"{where} must be {some or 'another value'}"
    return f"{where}: {what[:1].lower()}{what[1:]}"


def _named(kinds: str) -> str:
    """Return msgspec's names of types, and of their limits, in words."""

    def said(match: re.Match[str]) -> str:
        names = match[1].split(" | ")
        if "float" in names and "int" in names:
            names.remove("int")
        return " or ".join(_WORDS.get(one, one) for one in names)

    text = re.sub(r"`(.*?)`", said, kinds)
    text = re.sub(r"text of length (.*)", r"text \1 characters", text)
    text = re.sub(r"(list|object) of length (.*)", r"\1 \2 elements", text)
    return text.replace(" >=", " of at least").replace(" <=", " of at most")


def _choices(kind: Any) -> tuple[str, ...]:
    if get_origin(kind) is Literal:
        return get_args(kind)
    return tuple(one for part in get_args(kind) for one in _choices(part))


def operation(
    method: Literal["GET", "POST", "PUT", "DELETE"],
    path: str,
    *,
    in_query: tuple[str, ...] = (),
    takes: tuple[str, ...] = (),
    **about: Any,
) -> Callable[[F], F]:
    """Make a method of an interface ask an address, with its parameters as fields of the query or of the body."""

    def made(declared: F) -> F:
        hints = get_type_hints(declared, include_extras=True)
        answers = hints.pop("return")
        signature = inspect.signature(declared)
        defaults = {
            name: one.default
            for name, one in signature.parameters.items()
            if one.default is not one.empty and name != "id"
        }
        if answers is str and "media" not in about:  # a command
            hints["id"] = CommandId
            answers = Said
        hints = {name: kind for name, kind in hints.items() if name not in ("body", "media")}
        in_path = tuple(re.findall(r"{(\w+)}", path))
        all_in_query = method in ("GET", "DELETE") or bool(takes)
        query = {name: kind for name, kind in hints.items() if all_in_query or name in in_query}
        described = Operation(
            method=method,
            path=path,
            name=declared.__name__,
            says=inspect.getdoc(declared) or "",
            answers=answers,
            query=query,
            in_path=in_path,
            body=(
                None
                if all_in_query
                else {n: k for n, k in hints.items() if n not in query and n not in in_path}
            ),
            takes=takes,
            defaults=defaults,
            **about,
        )

        @wraps(declared)
        def ask(self: Any, *given: Any, **named: Any) -> Any:
            arguments = signature.bind(self, *given, **named).arguments
            del arguments["self"]
            return self.ask(described, arguments)

        vars(ask)["operation"] = described
        return ask  # type: ignore[return-value]

    return made


def operations_of(interface: type) -> Mapping[str, Operation]:
    """Return the operations that an interface declares, by the names of its methods."""
    return {
        name: vars(one)["operation"]
        for name, one in vars(interface).items()
        if "operation" in getattr(one, "__dict__", {})
    }
