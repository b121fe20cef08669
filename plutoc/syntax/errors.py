"""What can be wrong with a source before any name in it means anything: P0."""

from __future__ import annotations

import unicodedata

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix, Related, error
from plutoc.source import Source, Span
from plutoc.syntax.tokens import found, shortened, span


def unexpected(
    source: Source, span: Span, expected: str, found: str, help: str | None, fix: Fix | None
) -> Diagnostic:
    """Something else should stand here."""
    return error(
        "P0001",
        f"expected {expected}, found {found}",
        source,
        span,
        label=f"expected {expected}",
        help=help,
        fix=fix,
    )


def open_text(source: Source, span: Span) -> Diagnostic:
    """A text without its second quote."""
    return error(
        "P0002",
        "this text has no closing quote",
        source,
        span,
        label="begins here and must end on the same line",
        help='write `"` at its end; within a text a quote is written `\\"`',
    )


def unknown_character(
    source: Source, span: Span, help: str | None = None, fix: Fix | None = None
) -> Diagnostic:
    """A character that the language does not use, or several that were taken for one sign."""
    char = source.quote(span)
    # The name, too: a no-break space or a typographic dash cannot be told from the right one.
    is_plain = len(char) > 1 or (char.isascii() and char.isprintable())
    plain = f"`{shortened(char)}`" if is_plain else described(char)
    return error(
        "P0003",
        f"{plain} is not part of the language",
        source,
        span,
        label="not allowed here",
        help=help or _MEANT.get(char),
        fix=fix,
    )


_MEANT = {
    ";": "a statement ends with its line: write no `;`",
    "'": 'texts stand in double quotes: `"text"`',
    "“": 'texts stand in straight double quotes: `"text"`',
    "”": 'texts stand in straight double quotes: `"text"`',
    "„": 'texts stand in straight double quotes: `"text"`',
    "–": "write a minus or an arrow with the ordinary `-`",
    "—": "write a minus or an arrow with the ordinary `-`",
    "−": "write a minus or an arrow with the ordinary `-`",
    "\r": "end the lines as Unix or Windows does: an editor can convert them",
    "°": "degrees Celsius are written `C`, those of an angle `deg`",
    "/": "a comment begins with `#`",
    ">": "an arrow is written `->`",
    "-": "an arrow is written `->`, a part of a name `_`; "
    "a negative number has no space behind its `-`",
}


def hidden_character(source: Source, span: Span) -> Diagnostic:
    """A character in a text or a comment that a screen does not show."""
    char = source.quote(span)
    return error(
        "P0004",
        f"{described(char)} is not allowed in a text or a comment",
        source,
        span,
        label="here, where you may not see it",
        help="write spaces" if char == "\t" else "remove it: it hides or reorders what others see",
    )


def unknown_escape(source: Source, span: Span) -> Diagnostic:
    """A backslash before something else than a quote or a backslash."""
    return error(
        "P0005",
        f"`{source.quote(span)}` means nothing in a text",
        source,
        span,
        help='write `\\\\` for a backslash; the only other escape is `\\"`',
    )


def too_large(source: Source, limit: int) -> Diagnostic:
    """A file too large to have been written by hand."""
    return error(
        "P0006",
        f"this file is larger than {limit // 1024} KiB",
        source,
        Span(0, 0),
        help="split the app: one file holds one app, and a part can live in a package of blocks",
    )


def too_deep(source: Source, span: Span, limit: int) -> Diagnostic:
    """Lists in lists in lists."""
    return error(
        "P0007",
        f"brackets are nested more than {limit} deep",
        source,
        span,
        label="one too many",
        help="no block takes such a value",
    )


def unknown_version(source: Source, span: Span) -> Diagnostic:
    """A version of the language that this compiler does not know."""
    number = source.quote(span)
    is_newer = float(number) > 1
    return error(
        "P0008",
        f"this compiler reads version 1 of the language, not {shortened(number)}",
        source,
        span,
        label="the language's version",
        help=(
            "install a newer plutoc, or write `pluto 1`"
            if is_newer
            else "write `pluto 1`: it is the language's version, and there is none before it"
        ),
    )


def no_header(source: Source, span: Span) -> Diagnostic:
    """A file that does not begin with the language's version."""
    return error(
        "P0009",
        "a file begins with the version of the language, `pluto 1`",
        source,
        span,
        label="comes before it",
        help="write `pluto 1` on the first line",
        fix=Fix(span=Span(span.start, span.start), text="pluto 1\n"),
    )


def wrong_header(source: Source, span: Span) -> Diagnostic:
    """A first line that means to be the language's version."""
    return error(
        "P0016",
        "a file begins with the version of the language, `pluto 1`",
        source,
        span,
        label="not `pluto 1`",
        help="write `pluto 1` on the first line",
        fix=Fix(span=span, text="pluto 1"),
    )


def reserved_word(source: Source, span: Span) -> Diagnostic:
    """One of the language's words where a name should be."""
    word = source.quote(span)
    return error(
        "P0010",
        f"`{word}` is a word of the language and cannot be a name",
        source,
        span,
        label="choose another name",
        help=f"for instance `{word}_1`",
    )


def never_closed(source: Source, bracket: Span, end: int, fix: Fix | None = None) -> Diagnostic:
    """A bracket that nothing closes."""
    opening = source.quote(bracket)
    closing = {"(": ")", "[": "]", "{": "}"}[opening]
    return error(
        "P0011",
        f"this `{opening}` is never closed",
        source,
        bracket,
        label="opened here",
        related=(
            Related(source=source, span=Span(end, end), label=f"`{closing}` expected by here"),
        ),
        help=f"write `{closing}`",
        fix=fix,
    )


def unwritable_number(source: Source, span: Span, digits: int) -> Diagnostic:
    """A number with more digits than a computer keeps."""
    return error(
        "P0012",
        f"this number has more than {digits} digits",
        source,
        span,
        help="write it in another unit or with fewer digits",
    )


def second_app(source: Source, span: Span, first: Span | None) -> Diagnostic:
    """A file with two apps."""
    return error(
        "P0013",
        "a file holds one app",
        source,
        span,
        label="a second one",
        related=(Related(source=source, span=first, label="the first one"),) if first else (),
        help="give each app a file of its own",
    )


def late_use(source: Source, span: Span) -> Diagnostic:
    """A `use` behind the beginning of the app."""
    return error(
        "P0014",
        "`use` stands before the app",
        source,
        span,
        label="too late here",
        help="move this line up, right below `pluto 1`",
    )


def no_app(source: Source, span: Span, *, at_end: bool) -> Diagnostic:
    """A file without an app, or without the line that begins it."""
    return error(
        "P0015",
        "this file has no app",
        source,
        span,
        label="the file ends here" if at_end else "this stands in the braces of an app",
        help="write `app NAME { … }`" if at_end else "write `app NAME {` above it",
    )


def early_brace(source: Source, span: Span, last: Span) -> Diagnostic:
    """A closing brace, with more of the app behind it and the app's own at the end."""
    return error(
        "P0017",
        "this `}` ends the app, and more of it follows",
        source,
        span,
        label="too early",
        related=(Related(source=source, span=last, label="the app ends here, too"),),
        help="remove one of the two",
    )


def behind_the_app(source: Source, token: Token) -> Diagnostic:
    """Something behind the brace that ends the app."""
    end = "the end of the file"
    help = "what belongs to the app stands before its `}`"
    return unexpected(source, span(token), end, found(token), help, None)


def described(char: str) -> str:
    """Say which character it is: "U+00A0 (NO-BREAK SPACE)"."""
    name = "tab" if char == "\t" else unicodedata.name(char, "").lower()
    return f"the character U+{ord(char):04X}" + (f" ({name})" if name else "")
