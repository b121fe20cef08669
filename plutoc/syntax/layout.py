"""From the lexer's tokens to the parser's: which newlines end a statement, which words are names.

A newline ends a statement, except inside brackets and before a line that begins with `->`. Inside
brackets the language's words are ordinary names; so are `version`, `requires`, `mission`, `trip`,
`result`, `event` and `creator` wherever they do not begin a statement of theirs, and `has` but behind `mission` or `trip`, for
apps have blocks of such names; `takes` is a word only behind what an action declares. A bracket that was forgotten must
not swallow the rest of the file: a line that can only be the beginning of a statement closes what
was left open.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from lark import Token
from lark.lark import PostLex

from plutoc.syntax.tokens import (
    ARROW,
    BEGINNERS,
    CLOSING,
    COMMENT,
    END,
    EQUAL,
    NAME,
    NEWLINE,
    OPENING,
    OWNER_KINDS,
    REACTING_KINDS,
    SETTING_KINDS,
    SOFT_KINDS,
    WORDS,
)

DEEPEST = 64
"""How deep brackets are nested at most."""
MOST_DIGITS = 15
"""How many digits a number has at most: what a 64-bit float keeps."""

_WORDS = SOFT_KINDS | {word.upper() for word in WORDS}
_LINE_BEGINNERS = BEGINNERS - SOFT_KINDS | {"USE", "APP"}
_NAMES = SOFT_KINDS | {NAME}
"""What may turn out to be a name, of tokens that lie ahead."""
_BEFORE_TAKES = frozenset({NAME, "RPAR"})
"""What stands before `takes`, as it does before no name."""
_FOLLOWS_A_FIRST_NAME = _NAMES | {EQUAL, ARROW}
_FOLLOWS_A_NAME = CLOSING | {EQUAL, ARROW, "COMMA"}


class Layout(PostLex):
    """Lark's filter between its lexer and its parser."""

    always_accept = (COMMENT, NEWLINE, "OPEN_TEXT", "UNKNOWN")
    """Terminals that the lexer keeps, although no rule takes some of them."""

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        """Give the tokens that the parser is to see."""
        return _readable(_ended([token for token in stream if token.type != COMMENT]))


def _readable(tokens: Iterable[Token]) -> Iterator[Token]:
    """Give each number that is too long, and each bracket that is too deep, a type that no rule takes."""
    depth = 0
    for token in tokens:
        if token.type in OPENING:
            depth += 1
            if depth > DEEPEST:
                token = token.update(type="TOO_DEEP")
        elif token.type in CLOSING:
            depth = max(depth - 1, 0)
        elif token.type == NEWLINE:
            depth = 0
        elif token.type in ("NUMBER", "QUANTITY") and _digits(token) > MOST_DIGITS:
            token = token.update(type="LONG_NUMBER")
        yield token


def _digits(number: str) -> int:
    """Return how many digits a number has, its unit apart."""
    unit = number.lstrip("-0123456789.")
    return sum(map(str.isdigit, number[: len(number) - len(unit)]))


def _ended(tokens: Sequence[Token]) -> Iterator[Token]:
    """Give the tokens that the parser is to see, of those that are no comments.

    Never gives two newlines in a row, nor one at the beginning or behind `{`.
    """
    following = _following(tokens)
    depth = 0
    last = "LBRACE"  # as behind one: nothing before the first statement needs an end
    for i, token in enumerate(tokens):
        if token.type == NEWLINE:
            if depth and _begins_a_statement(tokens, i + 1):
                depth = 0
            if depth or last in (NEWLINE, "LBRACE") or following[i] in (ARROW, END):
                continue
        elif token.type in OPENING:
            depth += 1
        elif token.type in CLOSING:
            depth = max(depth - 1, 0)
        elif token.type == "RBRACE" and _ends_line(tokens, i):
            depth = 0
            if last not in (NEWLINE, "LBRACE"):
                yield _newline(tokens[i - 1])  # `}` on the line of the last statement
        elif token.type in _WORDS and (depth or _is_a_name(last, token.type, following[i])):
            token = token.update(type=NAME)
        last = token.type
        yield token
    if last not in (NEWLINE, "LBRACE", "RBRACE"):
        yield _newline(tokens[-1])


def _is_a_name(before: str, word: str, behind: str) -> bool:
    """Return whether a word outside of brackets is a name: a soft one that begins no statement."""
    if word == "HAS":
        return before not in OWNER_KINDS
    if word == "TAKES":
        return before not in _BEFORE_TAKES
    begins = before in (NEWLINE, "LBRACE") and behind not in _FOLLOWS_A_NAME
    return word in SOFT_KINDS and not begins


def _following(tokens: Sequence[Token]) -> list[str]:
    """Return for each token the type of the first one behind it that is no newline."""
    following = [END] * len(tokens)
    for i in range(len(tokens) - 1, 0, -1):
        here = tokens[i].type
        following[i - 1] = following[i] if here == NEWLINE else here
    return following


def _ends_line(tokens: Sequence[Token], i: int) -> bool:
    """Return whether nothing stands behind the i-th on its line."""
    return i + 1 == len(tokens) or tokens[i + 1].type == NEWLINE


def _begins_a_statement(tokens: Sequence[Token], i: int) -> bool:
    """Return whether the line whose first token is the i-th cannot go on with what is in brackets."""
    first, second, third = (*(t.type for t in tokens[i : i + 3]), END, END, END)[:3]
    if first == "RESULT" and second in _NAMES and third == "AS":
        return True
    if first in SETTING_KINDS and second == "TEXT":
        return True
    if first in REACTING_KINDS and second in _NAMES:
        return True
    if first in _NAMES:
        return second in _FOLLOWS_A_FIRST_NAME
    if first == "LSQB":
        return _is_followed_by_an_arrow(tokens, i)
    return first == "RBRACE" or (first in _LINE_BEGINNERS and second in _NAMES)


def _is_followed_by_an_arrow(tokens: Sequence[Token], i: int) -> bool:
    """Return whether the bracket that opens here is the first stop of a flow."""
    for at in range(i + 1, len(tokens)):
        if tokens[at].type == "RSQB":
            return at + 1 < len(tokens) and tokens[at + 1].type == ARROW
        if tokens[at].type != "COMMA" and tokens[at].type not in _NAMES:
            return False
    return False


def _newline(after: Token) -> Token:
    """Return a newline that is not in the source, right behind a token."""
    at = after.end_pos
    return Token(NEWLINE, "", at, after.line, after.column, after.line, after.column, at)
