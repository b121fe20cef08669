"""What a name in hooks.py is, by the words around it: the file is being typed, and may be no Python yet."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from plutoc.block import HookKind
from plutoc.hooks.expected import FOR_ALL, PASSED
from plutoc.service.hooks.types import HookType, Member

_DEF = re.compile(r"^([ \t]*)(?:async[ \t]+)?def[ \t]+(\w+)[ \t]*\(", re.MULTILINE)
_PARAMETER = re.compile(r"(\w+)[ \t]*(?::[ \t]*([^,=]+))?(?:=.*)?")
_MADE_OF = {"T": "Trip", "M": "Mission"}
_DEEPEST = 8
_BRACKETS = {")": "(", "]": "["}
_USUAL = {
    "drone": "Drone",
    "trip": "Trip",
    "context": "Context",
    "mission": "Mission",
    "results": "Results",
    "candidates": "Sequence[Drone]",
    "waiting": "Sequence[Waiting]",
    "drones": "Sequence[Drone]",
    "event": "Event",
    "now": "float",
}
"""The types of what comes by position, by its usual name."""


@dataclass(frozen=True, kw_only=True)
class Around:
    """The function in which a place lies, as a stretch of text."""

    text: str
    name: str
    parameters: Mapping[str, str]
    """Their types; empty where there is none."""
    types: Mapping[str, HookType]
    passed: tuple[str, ...]
    """What a hook of that name gets by position, by usual names."""

    @cached_property
    def _by_place(self) -> dict[str, str]:
        return {
            name: _USUAL[usual] for name, usual in zip(self.parameters, self.passed, strict=False)
        }

    def type_of(self, chain: str, depth: int = 0) -> str:
        """Return the type of an expression such as `mission.trips[0]`, or nothing."""
        if depth > _DEEPEST:
            return ""
        narrowed = re.search(rf"isinstance\(\s*{re.escape(chain)}\s*,\s*(\w+)", self.text)
        if narrowed and narrowed[1] in self.types:
            return narrowed[1]
        head, *rest = _parts(chain)
        found = self._root(head, depth)
        for part in rest:
            found = self._step(found, part)
        return found

    def _root(self, name: str, depth: int) -> str:
        annotated = _plain(self.parameters.get(name, ""))
        if annotated and _element(annotated)[0] in (*self.types, "Sequence"):
            return annotated
        if name in self._by_place:
            return self._by_place[name]
        if name in self.types:  # the type itself: made by a call, or an enumeration
            return f"type {name}"
        local = self._assigned(name, depth)
        return local or ("" if annotated else _USUAL.get(name, ""))

    def _assigned(self, name: str, depth: int) -> str:
        """Return the type of a local name: by its own annotation, what it is made of or goes through."""
        word = re.escape(name)
        looped = re.search(rf"\bfor\s+{word}\s+in\s+([\w.\[\]()]+)", self.text)
        if looped:
            return _element(self.type_of(looped[1], depth + 1))[1]
        noted = re.search(rf"^[ \t]*{word}[ \t]*:[ \t]*([^=\n]+)", self.text, re.MULTILINE)
        if noted and noted[1].strip() not in ("", "..."):
            return _plain(noted[1])
        pattern = rf"^[ \t]*{word}[ \t]*=[ \t]*(?:await[ \t]+)?(.+)$"
        made = re.search(pattern, self.text, re.MULTILINE)
        return self.type_of(_first_chain(made[1]), depth + 1) if made else ""

    def _step(self, found: str, part: str) -> str:
        if part == "[]":
            return _element(found)[1]
        if part == "()":
            return found.removeprefix("type ") if found.startswith("type ") else found
        member = self.member(found, part)
        return _plain(member.type) if member else ""

    def member(self, found: str, name: str) -> Member | None:
        """Return a member of a type by its name."""
        return next((one for one in self.members(found) if one.name == name), None)

    def members(self, found: str) -> tuple[Member, ...]:
        """Return what a type offers."""
        kind = self.types.get(found.removeprefix("type "))
        if kind is None or (found.startswith("type ") and not kind.is_enum):
            return ()
        return kind.members


def around(
    text: str, offset: int, types: Mapping[str, HookType], passed: Mapping[str, tuple[str, ...]]
) -> Around:
    """Return the function around a place; outside of every function, the whole file."""
    inner = None
    for match in _DEF.finditer(text):
        if match.start() > offset:
            break
        inner = match
    if inner is None or not _is_inside(text, inner, offset):
        return Around(text=text, name="", parameters={}, types=types, passed=())
    end = _end(text, inner)
    signature = _balanced(text, inner.end() - 1)
    parameters = {}
    for part in _split(signature):
        named = _PARAMETER.fullmatch(part.strip().lstrip("*"))
        if named:
            parameters[named[1]] = (named[2] or "").strip()
    return Around(
        text=text[inner.start() : end],
        name=inner[2],
        parameters=parameters,
        types=types,
        passed=_passed(passed.get(inner[2], ()), parameters),
    )


def _passed(usual: tuple[str, ...], parameters: Mapping[str, str]) -> tuple[str, ...]:
    """Return what a hook gets: a policy with three parameters chooses for all that wait."""
    is_policy = usual == PASSED[HookKind.POLICY] and not set(usual) & set(parameters)
    return FOR_ALL if is_policy and len(parameters) == len(FOR_ALL) else usual


def chain_before(text: str, end: int) -> str:
    """Return the expression that ends at a place: `context.live(drone)`; empty where there is none."""
    at = end
    while at > 0:
        before = text[at - 1]
        if before in _BRACKETS:
            opened = _opening(text, at - 1)
            if opened < 0:
                return ""
            at = opened
        elif before.isalnum() or before in "_.":
            at -= 1
        else:
            break
    return text[at:end]


def _opening(text: str, closing: int) -> int:
    depth = 0
    for at in range(closing, -1, -1):
        depth += (text[at] in ")]") - (text[at] in "([")
        if depth == 0:
            return at
    return -1


def _parts(chain: str) -> list[str]:
    """Split an expression: `a.b(c)[0]` is a, b, (), []."""
    found, at = [], 0
    while at < len(chain):
        if chain[at] in "([":
            end = _closing(chain, at)
            found.append("()" if chain[at] == "(" else "[]")
            at = end + 1
        elif chain[at].isalnum() or chain[at] == "_":
            word = re.match(r"\w+", chain[at:])
            assert word is not None
            found.append(word[0])
            at += len(word[0])
        else:
            at += 1
    return found or [""]


def _closing(text: str, opening: int) -> int:
    depth = 0
    for at in range(opening, len(text)):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0:
            return at
    return len(text) - 1


def _balanced(text: str, opening: int) -> str:
    return text[opening + 1 : _closing(text, opening)]


def _split(text: str) -> list[str]:
    """Split at commas that are in no brackets."""
    parts, depth, last = [], 0, 0
    for at, char in enumerate(text):
        depth += (char in "([{") - (char in ")]}")
        if char == "," and depth == 0:
            parts.append(text[last:at])
            last = at + 1
    return [*parts, text[last:]]


def _first_chain(text: str) -> str:
    at = 0
    while at < len(text) and (text[at].isalnum() or text[at] in "_.(["):
        at = _closing(text, at) + 1 if text[at] in "([" else at + 1
    return text[:at]


def _plain(annotation: str) -> str:
    """Return a type without quotes and without `| None`, its variables replaced."""
    text = annotation.strip().strip("\"'").replace("| None", "").replace("None |", "").strip()
    return re.sub(r"\b[TM]\b", lambda match: _MADE_OF[match[0]], text)


def _element(annotation: str) -> tuple[str, str]:
    """Split `list[Trip]` into `list` and `Trip`; of `Results[M, T]` the first word counts."""
    outer, _, inner = annotation.partition("[")
    element = inner.removesuffix("]")
    return outer, element.partition("[")[0].partition(",")[0].strip()


def _is_inside(text: str, match: re.Match[str], offset: int) -> bool:
    return offset <= _end(text, match)


def _end(text: str, match: re.Match[str]) -> int:
    """Return where a function ends: before the first line that is indented no more than its `def`."""
    indent = len(match[1].expandtabs())
    at = text.find("\n", _closing(text, match.end() - 1))
    while at >= 0:
        start = at + 1
        at = text.find("\n", start)
        line = text[start : at if at >= 0 else len(text)]
        bare = line.strip()
        depth = len(line.expandtabs()) - len(line.expandtabs().lstrip())
        if bare and not bare.startswith(("#", ")")) and depth <= indent:
            return start - 1
    return len(text)
