"""How one speaks of a plan where it was written: in a file by its keys, elsewhere in other words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from . import errors


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """What is said differently to whoever writes a file and to whoever never sees one."""

    called: Callable[[str], str]
    """What a key is called."""
    missing: Callable[[str], str]
    """A key that must be there is not."""
    no_trips: Callable[[], str]
    item_missing: Callable[[str], str]
    """An action that needs an item has none."""


IN_A_FILE = Wording(
    called=str,
    missing=errors.missing,
    no_trips=errors.no_trips,
    item_missing=errors.item_missing,
)
