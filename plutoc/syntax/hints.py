"""Hints for those who write the syntax of another language."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from lark import Token

from plutoc.source import Source
from plutoc.syntax.tokens import (
    ARROW,
    EQUAL,
    NAME,
    NEWLINE,
    OWNER_KINDS,
    SETTING_KINDS,
    SETTINGS,
    span,
)

_AMOUNTS = frozenset({"NUMBER", "QUANTITY"})
_OPENING = frozenset({"LPAR", "LSQB", "LBRACE"})
_LISTS = frozenset({"WHEN", "EMITS", "CAN", "WRITES"})
_AS_WRITTEN = {"version": '`version "1.2.0"`', "requires": '`requires "numpy>=2", "requests"`'}
_GUARDED = frozenset({"WHEN", "EMITS"})
_TYPED = frozenset({"ACTION", "EVENT", "MODIFIER", "EVALUATOR"})
_ALONE = frozenset({"EVALUATOR", "POLICY", "CREATOR"})
_BEFORE_A_NAME = frozenset({"let", "var", "val", "const", "block", "node", "new", "set", "auto"})
_OF_PYTHON = frozenset({"def", "class", "async", "await", "return", "from", "lambda", "print"})
GOES_ON_ABOVE = "a list ends with its line: go on in the line above, behind the comma"
_CONFLICT = ("<<<<<<<", "=======", ">>>>>>>", "|||||||")


def hint(source: Source, tokens: Sequence[Token], i: int, accepts: set[str]) -> str | None:
    """Say how it is written, where the i-th token of a line is no accident."""
    if i == 0:
        return "`pluto 1` stands once, on the first line" if tokens[0].type == "PLUTO" else None
    if i == len(tokens) - 1 and i == 1 and follows_a_comma(source, tokens[0]):
        return GOES_ON_ABOVE
    return (
        _of_settings(tokens, i)
        or _of_fields(tokens, i)
        or _of_values(tokens, i)
        or _of_guards(tokens, i, accepts)
        or _of_flows(tokens, i)
        or _of_declarations(tokens, i, accepts)
    )


def conflict(text: str, start: int) -> str | None:
    """Say what to do with the marks that a merge leaves."""
    if text.startswith(_CONFLICT, start) and text[start - 1 : start] in ("", "\n"):
        return "two versions were merged here: keep one, and remove the lines that mark them"
    return None


def _of_settings(tokens: Sequence[Token], i: int) -> str | None:
    token, first = tokens[i], tokens[0]
    if first.type in SETTING_KINDS and (i == 1 or tokens[i - 1].type == "COMMA"):
        if token.type in _OPENING:
            return f"the texts behind `{first}` stand there without brackets"
        return f"it stands in quotes, as in {_AS_WRITTEN[first]}"
    if first.type == "VERSION" and token.type == "COMMA":
        return "an app has one version"
    if first in SETTINGS and i == 2 and tokens[1].type == EQUAL and token.type in ("TEXT", "LSQB"):
        return f"write it without the `=`: {_AS_WRITTEN[first]}"
    return None


def _of_fields(tokens: Sequence[Token], i: int) -> str | None:
    token, before, after = tokens[i], tokens[i - 1], _at(tokens, i + 1)
    if tokens[0].type not in OWNER_KINDS:
        return None
    if before.type == "HAS" and token.type in _OPENING:
        return "the fields behind `has` stand there without brackets"
    if before.type != NAME or tokens[i - 2].type not in ("HAS", "COMMA"):
        return None
    if token.type == EQUAL and after:
        return f"a field has a type: `{before}: TYPE = {after}`"
    if token.type == "COMMA" or i == len(tokens) - 1:
        return f"a field has a type: `{before}: TYPE`"
    return None


def _of_values(tokens: Sequence[Token], i: int) -> str | None:
    token, before, after = tokens[i], tokens[i - 1], _at(tokens, i + 1)
    if token.type in _AMOUNTS and before.type == "COMMA" and i > 1:
        whole = tokens[i - 2]
        if whole.type == "NUMBER" and _touch(whole, before, token):
            return f"a number has a point instead of the comma: `{whole}.{token}`"
    if token.type in _AMOUNTS and before.type == "QUANTITY":
        return "a value is one number with one unit"
    if token.type == "DOT" and after and after.type in _AMOUNTS and _touch(token, after):
        return f"a number has a digit before its point: `0.{after}`"
    if token.type == "DOT" and before.type == "NUMBER":
        return f"a number has a digit behind its point: `{before}.0`"
    names_one = before.type == NAME and tokens[i - 2].type in ("LPAR", "COMMA")
    if not names_one or _open_bracket(tokens, i) != "LPAR":
        return None
    if token.type == EQUAL and tokens[0].type in _TYPED and after:
        return f"a parameter has a type: `{before}: TYPE = {after}`"
    if token.type in ("RPAR", "COMMA") and tokens[0].type in _TYPED:
        return f"a parameter has a type: `{before}: TYPE`"
    if token.type in ("RPAR", "COMMA"):
        return f"a value stands behind the name of its parameter: `NAME: {before}`"
    return None


def _of_guards(tokens: Sequence[Token], i: int, accepts: set[str]) -> str | None:
    token, before, after = tokens[i], tokens[i - 1], _at(tokens, i + 1)
    if before.type in _LISTS and token.type in _OPENING:
        return f"the names behind `{before}` stand there without brackets"
    if any(each.type in _GUARDED for each in tokens[:i]) and "COMMA" in accepts:
        if before == "not":
            return "name the statuses that are meant, or write `otherwise` for all the others"
        if token.type == EQUAL:
            return "only the names of statuses stand here, as in `when COMPLETED`"
        if token.type == ARROW:
            return "a guard ends its statement: begin the next one on a new line"
    if "WHEN" in accepts:
        if token.type == NAME and token.isupper():
            return f"write `when {token}`"
        if token.type in ("LSQB", "LPAR", "COLON") and after and after.isupper():
            return f"write `when {after}`"
    return None


def _of_flows(tokens: Sequence[Token], i: int) -> str | None:
    token, before = tokens[i], tokens[i - 1]
    if before.type == ARROW and token.type in ("LPAR", "LBRACE"):
        return "branches stand in `[` and `]`"
    if token.type == EQUAL and i > 1 and tokens[i - 2].type == ARROW:
        return f"declare it in a statement of its own: `{before} = KIND`"
    if any(each.type == ARROW for each in tokens[:i]) and _open_bracket(tokens, i) == "LSQB":
        if token.type == ARROW and any(each.type == "RSQB" for each in tokens[i:]):
            return "only names stand in brackets: draw a chain of blocks in a statement of its own"
        if token.type == "LSQB":
            return "name all branches in one pair of brackets"
    if token.type == "WHEN" and i == 1:
        return f"a guard stands at the end: `{before} -> BLOCK when STATUS`"
    return None


def _of_declarations(tokens: Sequence[Token], i: int, accepts: set[str]) -> str | None:
    token, before, first, after = tokens[i], tokens[i - 1], tokens[0], _at(tokens, i + 1)
    if first.type == "ACTION" and token.type == "COLON" and ARROW in accepts:
        return "write `->` before the type of what it gives"
    if token.type == ARROW and first.type in (*_ALONE, "MODIFIER"):
        return "only an action declares what it gives"
    if first.type in _ALONE and i == 2 and token.type in ("LPAR", "COMMA"):
        if token.type == "COMMA":
            return f"write `{first}` on a line of its own for each of them"
        return f"remove the brackets: what a {first} gets is clear from its being one"
    if token.type == NAME and "CAN" in accepts:
        return "write `can` before it"
    if token.type != NAME or before.type != NAME:
        return None
    if i == 1:
        if before in _OF_PYTHON:
            return "Python stands in the package's hooks.py; here, a hook is only declared"
        if before in _BEFORE_A_NAME:
            return f"remove `{before}`"
        if _is_kind(before) and token[:1].islower():
            return f"to declare a block, write `{token} = {before}`"
        if after and after.type == EQUAL:
            return f"a name has no space in it: for instance `{before}_{token}`"
    if i == 3 and tokens[1].type == EQUAL and before[:1].islower() and _is_kind(token):
        return f"remove `{before}`"
    if NEWLINE in accepts and after and after.type in (EQUAL, ARROW) and tokens[1].type == EQUAL:
        return "every statement begins on a line of its own"
    return None


def role_of_a_name(before: Sequence[Token]) -> str:
    """Say what the name would be that is missing behind these tokens of a line."""
    j = len(before) - 1
    while j > 0 and before[j].type in ("COMMA", NAME):
        j -= 1
    if j < 0:
        return "a name"
    kind = before[j].type
    if before[0].type == "ACTION" and kind == ARROW:
        return "a type" if j == len(before) - 1 else "a name"
    if kind == ARROW or (kind == "LSQB" and (j == 0 or before[j - 1].type == ARROW)):
        return "a block"
    if (kind == EQUAL and j == 1) or (kind == "DOT" and j == 3):
        return "a kind of block"
    return {"WHEN": "a status", "EMITS": "a status", "CAN": "an action", "HAS": "a field"}.get(
        kind, "a name"
    )


def follows_a_comma(source: Source, token: Token) -> bool:
    """Return whether the line above this one's first token ends with a comma."""
    line = source.line(max(1, source.position(span(token).start)[0] - 1))
    return line.split("#")[0].rstrip().endswith(",")


def _open_bracket(tokens: Sequence[Token], i: int) -> str | None:
    """Return the bracket that the i-th token of a line stands in; none has others in it."""
    signs = [token.type for token in tokens[:i] if token.type in ("LPAR", "LSQB", "RSQB", "RPAR")]
    return signs[-1] if signs and signs[-1] in ("LPAR", "LSQB") else None


def _is_kind(token: Token) -> bool:
    return token[:1].isupper() and not token.isupper()


def _touch(*tokens: Token) -> bool:
    return all(one.end_pos == other.start_pos for one, other in pairwise(tokens))


def _at(tokens: Sequence[Token], i: int) -> Token | None:
    """Return the i-th token of a line, if it is more than the end of it."""
    return tokens[i] if i < len(tokens) - 1 else None
