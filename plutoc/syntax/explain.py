"""The diagnostic of one syntax error: why the parser cannot continue here."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.characters import slip
from plutoc.syntax.grammar import State, would_feed
from plutoc.syntax.hints import GOES_ON_ABOVE, conflict, follows_a_comma, hint, role_of_a_name
from plutoc.syntax.layout import DEEPEST, MOST_DIGITS
from plutoc.syntax.texts import written_out
from plutoc.syntax.tokens import (
    CLOSING,
    END,
    EQUAL,
    HAS,
    NAME,
    NEWLINE,
    OPENING,
    OWNER_KINDS,
    OWNERS,
    RESULT,
    SETTINGS,
    WORDS,
    expected,
    found,
    made_up,
    span,
)

_LINE_WORDS = ("use", "app")
_STATEMENT_WORDS = ("category", "event", "action", "evaluator", "modifier", "policy", "creator")
_TAIL_WORDS = frozenset({"WHEN", "OTHERWISE", "CAN", "EMITS", "WRITES", "AS"})
_ADDABLE = {
    "COLON": ":",
    "COMMA": ",",
    EQUAL: "=",
    "_ARROW": "->",
    "LPAR": "(",
    "RPAR": ")",
    "LSQB": "[",
    "RSQB": "]",
    "LBRACE": "{",
    "HAS": HAS,
}
"""Tokens whose lack can be mended by writing them: the first that fits is proposed."""
_CHOICES = frozenset({EQUAL, "_ARROW"})
_JOINING = frozenset({"and", "or"})

_OTHER_WORDS = {
    **dict.fromkeys(("if", "on", "where", "case"), "when"),
    **dict.fromkeys(("else", "default", "others"), "otherwise"),
    **dict.fromkeys(("import", "using", "require", "include"), "use"),
    **dict.fromkeys(("does", "able", "has"), "can"),
    **dict.fromkeys(("returns", "yields", "sends"), "emits"),
    **dict.fromkeys(("program", "application", "mission"), "app"),
}
"""What other languages say."""
_OTHER_HAS = dict.fromkeys(("have", "had", "can", "with", "takes", "gets"), "has")
_OTHER_SETTINGS = {
    **dict.fromkeys(("require", "depends", "dependencies", "needs", "install"), "requires"),
    **dict.fromkeys(("release", "revision"), "version"),
}
"""The same before a text: there `require` is no `use`."""


def explain(
    source: Source,
    base: State,
    state: State,
    tokens: Sequence[Token],
    i: int,
    app: Token | None,
) -> Diagnostic:
    """Say what is wrong with the i-th token of a line, at which `state` cannot go on.

    The last of the tokens is what ends the line; `base` is the parser before the line.
    """
    token, here = tokens[i], _place(tokens, i)
    accepts = state.accepts()
    special = _special(source, base, tokens, i, here)
    if special is not None:
        return special
    if i == len(tokens) - 1 or token.type == "RBRACE":
        left_open = _left_open(tokens[:i])
        if left_open is not None:
            closing = {"(": ")", "[": "]"}[str(left_open)]
            more = [made_up(OPENING[left_open.type], closing), *tokens[i:]]
            fix = _certain(state, more, Span(here.start, here.start), closing)
            if "#" in source.text[here.start : span(tokens[-1]).start]:
                fix = None  # the bracket may be in the comment
            return errors.never_closed(source, span(left_open), here.start, fix)
    if token.type == "APP" and i == 0 and app is not None and "CATEGORY" in accepts:
        return errors.second_app(source, here, span(app))
    if token.type == "USE" and i == 0:
        return errors.late_use(source, here)
    if _is_reserved(tokens, i, accepts):
        return errors.reserved_word(source, here)
    first = tokens[0]
    if i == 1 and first.type.lower() in _STATEMENT_WORDS and token.type in _CHOICES:
        return errors.reserved_word(source, span(first))
    merge = conflict(source.text, here.start) if i == 0 else None
    help, fix = (merge, None) if merge else _help(source, base, state, tokens, i, accepts)
    wanted = expected(accepts, role_of_a_name(tokens[:i]))
    return errors.unexpected(source, here, wanted, found(token), help, fix)


def _special(
    source: Source, base: State, tokens: Sequence[Token], i: int, here: Span
) -> Diagnostic | None:
    """Explain what is no token of the language at all."""
    match tokens[i].type:
        case "OPEN_TEXT":
            return errors.open_text(source, here)
        case "UNKNOWN":
            return slip(source, base, tokens, i) or errors.unknown_character(source, here)
        case "TOO_DEEP":
            return errors.too_deep(source, here, DEEPEST)
        case "LONG_NUMBER":
            number = len(tokens[i]) - len(tokens[i].lstrip("-0123456789."))  # without its unit
            where = Span(here.start, here.start + number)
            return errors.unwritable_number(source, where, MOST_DIGITS)
        case _:
            return None


def _is_reserved(tokens: Sequence[Token], i: int, accepts: set[str]) -> bool:
    """Return whether one of the language's words stands where only a name can."""
    if tokens[i].type.lower() not in WORDS or NAME not in accepts:
        return False
    return i > 0 or tokens[1].type in _CHOICES


def _left_open(tokens: Sequence[Token]) -> Token | None:
    """Return the innermost bracket that is left open."""
    left: list[Token] = []
    for token in tokens:
        if token.type in OPENING:
            left.append(token)
        elif token.type in CLOSING and left:
            left.pop()
    return left[-1] if left else None


def _help(
    source: Source, base: State, state: State, tokens: Sequence[Token], i: int, accepts: set[str]
) -> tuple[str | None, Fix | None]:
    """Say how to mend it, where that is clear."""
    token, first, rest = tokens[i], tokens[0], tokens[i + 1 :]
    joined_by = _joined_by(state, tokens, i, accepts)
    if joined_by:
        return joined_by
    if token.type in (NAME, *OWNER_KINDS) or "HAS" in accepts:
        possible = [word for word in (*WORDS, HAS) if word.upper() in accepts]
        word = _word(token, possible, _OTHER_WORDS | _OTHER_HAS)
        if word:
            return _meant(state, token, word, rest)
    if i == 1 and first.type == NAME:
        if token == HAS:
            word = _word(first, OWNERS)
        elif token.type == "TEXT":
            word = _word(first, SETTINGS, _OTHER_SETTINGS)
        else:
            word = _word(first, [*_STATEMENT_WORDS, *_LINE_WORDS, RESULT])
        if word and (token.type in (NAME, "TEXT") or word.upper() == token.type):
            return _meant(base, first, word, tokens[1:])
    if i == 1 and token.type == "COLON" and follows_a_comma(source, first):
        return GOES_ON_ABOVE, None
    for given, wanted in (("COLON", EQUAL), (EQUAL, "COLON")):
        text = _ADDABLE[wanted]
        if token.type == given and wanted in accepts:
            fix = _certain(state, [made_up(wanted, text), *rest], span(token), text)
            if fix:
                return f"write `{text}` here", fix
    if token.type in _TAIL_WORDS and i == 0:
        return f"`{token}` goes on the line of the statement that it belongs to", None
    if i == len(tokens) - 1 and i and tokens[i - 1].type == "_ARROW":
        return "to go on in the next line, begin that one with `->`", None
    if token.type == "LBRACE" and i == 0:
        return "`{` stands at the end of the line that begins the app", None
    if i and tokens[i - 1].type == "QUANTITY":
        number = written_out(tokens[i - 1])
        if number:
            return number, None
    said = hint(source, tokens, i, accepts)
    if said:
        return said, None
    if token.type == "QUANTITY" and NAME in accepts:
        return "a name begins with a letter", None
    return _missing(state, tokens, i, accepts)


def _joined_by(
    state: State, tokens: Sequence[Token], i: int, accepts: set[str]
) -> tuple[str, Fix | None] | None:
    """Say that a list has commas, where a word joins its last two: `can spray and measure`."""
    if "COMMA" not in accepts or i < 2:
        return None
    token, before, rest = tokens[i], tokens[i - 1], tokens[i + 1 :]
    if token in _JOINING:
        # of a fork's branches all are taken: with `or`, something else may be meant
        forks = token == "or" and any(t.type == "_ARROW" for t in tokens[:i])
        certain = not forks or any(t.type == "WHEN" for t in tokens[:i])
        where = Span(span(before).end, span(token).end)
        fix = _certain(state, [made_up("COMMA", ","), *rest], where, ",") if certain else None
        return f"a list has commas: write `,` instead of `{token}`", fix
    if before in _JOINING and tokens[i - 2].type == "COMMA":
        return f"a list has commas only: remove `{before}`", None
    return None


def _missing(
    state: State, tokens: Sequence[Token], i: int, accepts: set[str]
) -> tuple[str | None, Fix | None]:
    """Propose to write what is missing, or else to remove what is too much."""
    token = tokens[i]
    arrow = token.type == NAME and token[:1].islower()  # a block, where a kind may be meant, too
    for kind, text in _ADDABLE.items():
        if kind == EQUAL and arrow:
            continue
        if kind in accepts and would_feed(state, [made_up(kind, text), *tokens[i : i + 2]]):
            at = Span(*[span(tokens[i - 1]).end if i else span(token).start] * 2)
            more = [made_up(kind, text), *tokens[i:]]
            certain = kind == "COLON" or (kind == "COMMA" and tokens[i + 1].type == "COLON")
            fix = _certain(state, more, at, text) if certain else None
            return f"write `{text}` before it", fix
    if i < len(tokens) - 1 and _mends(state, tokens[i + 1 :]):
        return f"remove {found(token)}", None
    return None, None


def _word(
    token: Token, possible: Sequence[str], others: Mapping[str, str] = _OTHER_WORDS
) -> str | None:
    """Return which of the language's words was meant; `others` are those of other languages."""
    other = others.get(token.casefold())
    if other in possible:
        return other
    near = difflib.get_close_matches(token.casefold(), possible, 1, 0.7)
    return near[0] if near else None


def _meant(state: State, token: Token, word: str, rest: Sequence[Token]) -> tuple[str, Fix | None]:
    line = [made_up(word.upper(), word), *rest]
    given = token.casefold()
    certain = given == word or given in (_OTHER_SETTINGS if word in SETTINGS else _OTHER_WORDS)
    fix = _certain(state, line, span(token), word) if certain else None
    return f"did you mean `{word}`?", fix


def _certain(state: State, tokens: Sequence[Token], where: Span, text: str) -> Fix | None:
    """Return a fix, if the rest of the line is in order after it."""
    return Fix(span=where, text=text) if _mends(state, tokens) else None


def _mends(state: State, tokens: Sequence[Token]) -> bool:
    *line, _ = tokens
    opens = bool(line) and line[-1].type == "LBRACE"
    return would_feed(state, line if opens else [*line, made_up(NEWLINE, "")])


def _place(tokens: Sequence[Token], i: int) -> Span:
    """Return where to point. What ends a line is missed behind the token before it."""
    if i == len(tokens) - 1 or tokens[i].type in (NEWLINE, END):
        end = span(tokens[i - 1]).end
        return Span(end, end)
    return span(tokens[i])
