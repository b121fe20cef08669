"""Things in the order in which they came; any of them can leave, and none takes room of the chain's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Generic, Protocol, TypeVar


class Link(Protocol):
    """What can be in a chain: it knows its neighbours."""

    before: Any
    after: Any


L = TypeVar("L", bound=Link)


class Chain(Generic[L]):
    """All that have come and not left."""

    __slots__ = ("_first", "_last")

    def __init__(self) -> None:
        self._first: L | None = None
        self._last: L | None = None

    def add(self, link: L) -> None:
        """Take one in, behind all others; it is in no chain yet."""
        last = self._last
        link.before, link.after = last, None
        if last is None:
            self._first = link
        else:
            last.after = link
        self._last = link

    def remove(self, link: L) -> None:
        """Let one go, if it has not left already."""
        before, after = link.before, link.after
        if before is not None:
            before.after = after
        elif self._first is link:
            self._first = after
        else:
            return
        if after is not None:
            after.before = before
        else:
            self._last = before
        link.before = link.after = None

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __iter__(self) -> Iterator[L]:
        """Give all that are here now, whoever comes or leaves meanwhile."""
        here, link = [], self._first
        while link is not None:
            here.append(link)
            link = link.after
        return iter(here)
