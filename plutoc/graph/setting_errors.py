"""What can be wrong with the settings of a package, `version` and `requires` (P1)."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diagnostic import Diagnostic, Related, error, warning
from plutoc.edits import without_item
from plutoc.source import Source, Span
from plutoc.syntax.tokens import shortened
from plutoc.syntax.tree import Text

_ALL_IN_ONE = {
    "version": "an app has one version: remove one of them",
    "requires": "write all libraries behind the first one, with commas between them",
}


def no_version(source: Source, text: Text, meant: str | None) -> Diagnostic:
    """A version that no installer understands."""
    return error(
        "P1040",
        f"`{shortened(text.value)}` is not a version" if text.value else "this version is empty",
        source,
        text.span,
        help=(
            f'did you mean `version "{shortened(meant)}"`?'
            if meant
            else 'a version has numbers with points between them: `version "1.2.0"`'
        ),
    )


def no_requirement(
    source: Source, text: Text, several: Sequence[str], meant: str | None
) -> Diagnostic:
    """A requirement that no installer understands; `several` are those that stand in one text."""
    value = text.value
    if several:
        help = f"each stands in quotes of its own: `{', '.join(map(_quoted, several))}`"
    elif meant:
        help = f"did you mean `{_quoted(meant)}`?"
    elif "/" in value:
        help = "what is in no index has its name before its address: `numpy @ https://…`"
    else:
        help = "write the name that pip installs it by, and which versions will do: `numpy>=2`"
    return error(
        "P1041",
        (
            f"`{shortened(value)}` is not a library that pip could install"
            if value.strip()
            else "this requirement is empty"
        ),
        source,
        text.span,
        help=help,
    )


def second_setting(source: Source, word: str, span: Span, first: Span) -> Diagnostic:
    """A statement once more that an app has once."""
    return error(
        "P1042",
        f"`{word}` stands once in an app",
        source,
        span,
        label="the second time",
        related=(Related(source, first, "the first time"),),
        help=_ALL_IN_ONE[word],
    )


def required_twice(
    source: Source, text: Text, first: Text, both: str | None, *, same: bool
) -> Diagnostic:
    """A library that is required twice; `both` says it in one."""
    return warning(
        "P1043",
        f"`{shortened(text.value)}` names a library that is required already",
        source,
        text.span,
        label="the second time",
        related=(Related(source, first.span, "the first time"),),
        help=f"write one for both: `{_quoted(both)}`" if both else "remove one of them",
        fix=without_item(source, text.span) if same else None,
    )


def own_requirement(source: Source, text: Text, app: str, is_fleet: bool) -> Diagnostic:
    """The app itself, or the library that flies it: which version fits is not for the app to say."""
    return error(
        "P1044",
        (
            "an app does not require what flies it: the extras of its package do"
            if is_fleet
            else f"the app `{app}` cannot require itself"
        ),
        source,
        text.span,
        help=(
            f"remove it, and install the package with its extra: `{app.rstrip('_')}[fleet]`"
            if is_fleet
            else "remove it"
        ),
        fix=without_item(source, text.span),
    )


def _quoted(requirement: str) -> str:
    return f'"{requirement}"'
