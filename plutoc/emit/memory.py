"""What need not be done twice: a text that was made of the same before, by the same means.

Black and Jinja2 take most of the time of a small compile, and most of that to be imported. What they
once made of a text is kept in the user's cache, and looked up by all that it came of: the text, and
who made it. What is not there exactly as it was written is made anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache

from plutoc import __version__
from plutoc.cache import recalled
from plutoc.installed import facts_of_release

SHELF = "texts"
_NUL = b"\0"


def remembered(made_of: Iterable[str], make: Callable[[], str]) -> str:
    """Return what is made of some texts, made now or at another time."""
    return _text(_recalled(made_of, lambda: _bytes(make())))


def all_remembered(made_of: Iterable[str], make: Callable[[], Iterable[str]]) -> list[str]:
    """Return several texts that are made of some others; in none of them is a NUL.

    They are told apart before they are decoded: one sign that is not ASCII makes a text several
    times as large, and all that is done with it dearer.
    """
    made = _recalled(made_of, lambda: _NUL.join(map(_bytes, make())))
    return list(map(_text, made.split(_NUL)))


def _recalled(made_of: Iterable[str], make: Callable[[], bytes]) -> bytes:
    facts = "".join(f"{len(one)}:{one}" for one in (__version__, *made_of))
    return recalled(SHELF, _bytes(facts), make)


def _text(data: bytes) -> str:
    return data.decode("utf-8", "surrogatepass")


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


@cache
def edition(package: str) -> str:
    """Return what tells an installed package from another release of it, without importing it."""
    return "\n".join(facts_of_release(package))
