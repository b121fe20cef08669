"""A generated module in logical lines, and the shape of each: what Black goes by.

Of a line that fits, Black looks at what kinds of words and signs it has, and where the blanks are,
but not at how names are spelled. So lines of one shape are all left alone, or none is. What has
several lines between brackets is told apart into its head, its elements and its end: each stands or
falls by itself. What Black may go by otherwise (odd quotes, odd numbers, comments for tools) has no
shape.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from keyword import kwlist

from plutoc.emit.python import LINE_LENGTH

INDENT = 4
_CONTINUED = "\x01"
_ODD = "\x00"

_TOKEN = re.compile(
    r'(?P<long>f?"""(?:[^"\\]|\\.|"(?!""))*+""")'
    r'|(?P<text>f?"(?:[^"\\\n]|\\[^"\n])*+")'
    r"|(?P<quotes>'[^'\\\n]*\"[^'\\\n]*')"  # those in it would need escapes
    r"|(?P<comment>\#[^\n]*)"
    r"|(?P<word>[A-Za-z_]\w*)"
    r"|(?P<number>\d[\w.]*(?:(?<=e)[+-]\d+)?)"
    r"|(?P<odd>[\"'\\\t\r\f;]|[^\x00-\x7f])",
    re.DOTALL,
)
_KEPT = frozenset([*kwlist, "match", "case", "type", "_", "print", "exec"])
_NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]\d+)?")
_PLAIN_COMMENT = re.compile(r"# (?!.*(?:fmt:|yapf:|type:))\S.*(?<!\s)")
_DOTTED = re.compile(r"\bx(?:\.x)+(?![\w(\[])")
_ATOM = re.compile(
    r"(?<=[(\[{=])(?:s|0|None|True|False)(?=[,)\]}]|$)|(?<=[,:=] )(?:s|0|None|True|False)(?=[,)\]}]|$)"
)
_KEY = re.compile(r"(?<=[{ ])s(?=: )|^s(?=: )")
_MORE = re.compile(r"(, x(?:=x)?)\1+(?=[,)\]}]|$)")
_CLOSING = (")", "]", "}")
_DISPLAY = re.compile(r"(?<![\w\])}])[(\[{]$")
_SUBSCRIPT = re.compile(r"[\w\])}]\[$")
_BRACKETS = re.compile(r"[()\[\]{}]")


@dataclass(frozen=True, slots=True, kw_only=True)
class Logical:
    """A statement's line, or a comment's, however many lines it takes."""

    lines: tuple[str, ...]
    blanks: int
    """How many empty lines stand before it."""
    shapes: tuple[str, ...] | None
    """None: only Black knows."""

    @property
    def indent(self) -> int:
        """How far it is indented."""
        return len(self.lines[0]) - len(self.lines[0].lstrip(" "))


def logical_lines(text: str) -> list[Logical]:
    """Return a module's logical lines."""
    found: list[Logical] = []
    lines = text.split("\n")
    blanks, begin, depth = 0, 0, 0
    shapes = _shaped(text).split("\n")
    for number, shape in enumerate(shapes):
        if not shape.strip() and begin == number:
            blanks, begin = blanks + 1, number + 1
            continue
        depth += sum(1 if one in "([{" else -1 for one in _BRACKETS.findall(shape))
        goes_on = number + 1 < len(shapes) and shapes[number + 1].startswith(_CONTINUED)
        if depth <= 0 and not goes_on:
            end = number + 1
            own = tuple(lines[begin:end])
            told = _told(own, shapes[begin:end])
            found.append(Logical(lines=own, blanks=blanks, shapes=told))
            blanks, begin, depth = 0, end, 0
    if begin < len(lines) and any(line.strip() for line in lines[begin:]):
        found.append(Logical(lines=tuple(lines[begin:]), blanks=blanks, shapes=None))
    return found


def _shaped(text: str) -> str:
    """Return a text with every token as its kind; as many lines as before."""

    def kind(match: re.Match[str]) -> str:
        token = match[0]
        match match.lastgroup:
            case "word":
                return token if token in _KEPT else "x"
            case "text":
                if token[0] != "f":
                    return "s"
                return "f's'" if re.search(r"[\\']", token) is None else _ODD
            case "quotes":
                return "s"
            case "comment":
                return "#" if _PLAIN_COMMENT.fullmatch(token) else _ODD
            case "number":
                return "0" if _NUMBER.fullmatch(token) else _ODD
            case "long":
                return _long(match, token)
            case _:
                return _ODD

    return _TOKEN.sub(kind, text)


def _long(match: re.Match[str], token: str) -> str:
    """Return the kind of a text in three quotes: of one that documents, if it is as Black has it."""
    begin = match.string.rfind("\n", 0, match.start()) + 1
    before = match.string[begin : match.start()]
    more = f"\n{_CONTINUED}" * token.count("\n")
    if before.strip():
        return f"T{more}"
    first, *rest = token[3:-3].split("\n")
    filled = [line for line in rest if line.strip()]
    plain = (
        "\\" not in token
        and "\t" not in token
        and first[:1] not in ("", " ", '"')
        and all(line == line.rstrip() for line in (first, *rest[:-1]))
        and all(line.startswith(before) for line in filled)
        and (
            rest[-1] == before
            and rest[-2:-1] != [""]
            and first != ""
            and (len(rest) > 1)
            and any(line[len(before) : len(before) + 1] != " " for line in filled)
            if rest
            else first[-1:] not in (" ", '"') and len(before) + len(token) <= LINE_LENGTH
        )
    )
    return (f"D{'+' if rest else ''}" if plain else _ODD) + more


def _told(lines: tuple[str, ...], shapes: list[str]) -> tuple[str, ...] | None:
    """Return the shapes of a logical line's parts."""
    if any(_ODD in shape for shape in shapes):
        return None
    if len(lines) == 1 or all(shape.startswith(_CONTINUED) for shape in shapes[1:]):
        whole = shapes[0].strip() + "".join(shapes[1:]).replace(_CONTINUED, "")
        left_alone = len(lines) > 1 or whole == "#" or _fits(lines[0])  # a comment is never broken
        return (_general(whole),) if left_alone else None
    if any(shape.startswith(_CONTINUED) for shape in shapes):
        return None
    if not all(_fits(line) for line in lines):
        return None
    parts = tuple(_parts(lines, shapes))
    return None if "" in parts else tuple(map(_general, parts))


@cache
def _general(shape: str) -> str:
    """Return a shape in which a name, a text or a number, alone or in a row, are all the same."""
    shape = _ATOM.sub("x", _DOTTED.sub("x", shape))
    return _MORE.sub(r"\1", _KEY.sub("x", shape))


def _fits(line: str) -> bool:
    return len(line) <= (LINE_LENGTH if line.isascii() else LINE_LENGTH // 2)


@dataclass(slots=True)
class _Open:
    """A bracket that is not closed yet."""

    head: int
    """The number of its line."""
    elements: int = 0
    with_comma: int = 0

    def add(self, shape: str) -> None:
        """Count an element by its last line."""
        self.elements += 1
        self.with_comma += shape.endswith(",")


def _parts(lines: tuple[str, ...], shapes: list[str]) -> Iterator[str]:
    """Yield a shape a line; an empty one where the lines do not stand as Black has them."""
    stack: list[_Open] = []
    for number, shape in enumerate(map(str.strip, shapes)):
        indent = _indent(lines[number])
        if shape[:1] in _CLOSING:
            if not stack or _balance(shape[1:]) or indent != _indent(lines[stack[-1].head]):
                yield ""
                return
            closed = stack.pop()
            whole = sum(len(line.strip()) for line in lines[closed.head : number + 1])
            fits = number - closed.head == 2 and indent + whole <= LINE_LENGTH
            between = shapes[number - 1].strip()
            kind = _kind(closed, shapes[closed.head].strip(), between, fits=fits)
            yield f"{kind} {shapes[closed.head].strip()} {shape}" if kind else ""
            if stack:
                stack[-1].add(shape)
            continue
        if stack and indent != _indent(lines[stack[-1].head]) + INDENT:
            yield ""
        balance = _balance(shape)
        if balance == 1 and shape[-1] in "([{":
            stack.append(_Open(head=number))
        elif balance:
            yield ""
        elif stack:
            if shape != "#":
                stack[-1].add(shape)
            yield f"- {shape}"


def _kind(closed: _Open, head: str, between: str, *, fits: bool) -> str:
    """Return how what is between brackets is broken; nothing where Black would do it otherwise."""
    is_display = _DISPLAY.search(head) is not None
    if closed.elements == closed.with_comma > 0:
        # the comma of a tuple of one keeps nothing apart, nor does that of a subscript
        keeps = closed.elements > 1 or not (
            (is_display and head[-1] == "(") or _SUBSCRIPT.search(head)
        )
        return "each" if keeps or not fits else ""
    if closed.elements != 1 or closed.with_comma or fits:
        return ""
    if is_display and "," in between:
        return ""  # it gets an element a line
    return "one"


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _balance(shape: str) -> int:
    """Return how many brackets are left open; a large number where others are closed."""
    depth = 0
    for one in _BRACKETS.findall(shape):
        depth += 1 if one in "([{" else -1
        if depth < 0:
            return 99
    return depth
