"""What need not be done twice: a text that was made of the same before, by the same means.

Black and Jinja2 take most of the time of a small compile, and most of that to be imported. What they
once made of a text is kept in the user's cache, and looked up by all that it came of: the text, and
who made it. What is not there exactly as it was written is made anew.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from plutoc import __version__
from plutoc.cache import recalled
from plutoc.installed import facts_of_release

SHELF = "texts"


def remembered(made_of: tuple[str, ...], make: Callable[[], str]) -> str:
    """Return what is made of some texts, made now or at another time."""
    facts = "".join(f"{len(one)}:{one}" for one in (__version__, *made_of))
    made = recalled(SHELF, _bytes(facts), lambda: _bytes(make()))
    return made.decode("utf-8", "surrogatepass")


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


@cache
def edition(package: str) -> str:
    """Return what tells an installed package from another release of it, without importing it."""
    return "\n".join(facts_of_release(package))
