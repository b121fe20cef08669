"""How the sentences of this phase are put together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plutoc.graph.names import near
from plutoc.syntax.errors import described
from plutoc.syntax.tokens import joined
from plutoc_runtime.domain.quantities import Type

_UNITS = {
    **dict.fromkeys(("millisecond", "msec"), "ms"),
    **dict.fromkeys(("second", "sec"), "s"),
    **dict.fromkeys(("minute", "mn"), "min"),
    **dict.fromkeys(("hour", "hr"), "h"),
    **dict.fromkeys(("metre", "meter"), "m"),
    **dict.fromkeys(("kilometre", "kilometer"), "km"),
    **dict.fromkeys(("gram", "gramme", "gr"), "g"),
    **dict.fromkeys(("kilogram", "kilo"), "kg"),
    **dict.fromkeys(("degree", "°"), "deg"),
    **dict.fromkeys(("percent", "pct", "pc"), "%"),
    **dict.fromkeys(("kmh", "kph"), "km/h"),
    **dict.fromkeys(("mp", "ms", "m/sec"), "m/s"),
    **dict.fromkeys(("celsiu", "degc"), "C"),
    **dict.fromkeys(("kelvin",), "K"),
}
"""What people write, less an `s` at its end, for each unit."""


def meant(name: str, options: Iterable[str]) -> str | None:
    """Ask for what may have been meant; say which letter only looks like a plain one."""
    question = alternatives(near(name, options), "did you mean ", "?")
    strange = strange_letter(name)
    return "; ".join(filter(None, (strange, question))) or None


def strange_letter(name: str) -> str | None:
    """Say which letter of a name is none of ours: it may look just like one of them."""
    char = next((char for char in name if not char.isascii()), None)
    return f"the letter `{char}` is {described(char)}" if char else None


def unit_meant(unit: str, units: Sequence[str]) -> str | None:
    """Ask for the unit that may have been meant."""
    stem = unit.lower().removesuffix("s")
    word = _UNITS.get(stem, stem)
    return f"did you mean `{word}`?" if word in units else meant(unit, units)


def alternatives(names: Sequence[str], before: str, after: str) -> str | None:
    return f"{before}{either(names)}{after}" if names else None


def there_are(names: Sequence[str], what: str) -> str | None:
    return f"{what} are {all_of(names)}" if names else None


def either(names: Sequence[str]) -> str:
    return _quoted(names, "or")


def all_of(names: Sequence[str]) -> str:
    return _quoted(names, "and")


def _quoted(names: Sequence[str], last: str) -> str:
    return joined([f"`{name}`" for name in names], last)


def a_kind(kind: Type) -> str:
    return article(kind.value)


def article(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"
