"""Finding the smallest fleet that can be promised.

For a set of categories that can do all the work between them, drones are doubled until a fleet leaves
hope, and then taken away again: by halving, a category after the other, in every order. As more drones
are not always better, the neighbours of what is left are tried, too. Only the smallest is flown as often
as a promise takes; if it cannot be promised, the search goes on without it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, pairwise, permutations

from .fleets import Counts, Stock
from .tries import Tries

_LOOK_BELOW = 3
"""How many sizes below the smallest that halving has found are tried."""

_MOST_ORDERS = 6

_MOST_SIZES = 64
"""How many sizes are asked for where the largest is in vain."""


class Search:
    """Looks for the smallest fleet among those of a stock."""

    def __init__(
        self, tries: Tries, able: Callable[[Counts], bool], in_vain: Callable[[Counts], bool]
    ) -> None:
        """`able` says whether a fleet could do each trip if it had the time.

        `in_vain` is asked when no fleet that was tried has held: whether one surely will not.
        """
        self._tries, self._able, self._in_vain = tries, able, in_vain
        self._stock: Stock = tries.stock

    def smallest(self) -> Counts | None:
        """Return the smallest fleet that can be promised; None: there is none."""
        sets = list(self._able_sets())
        while (found := self.hopeful(sets)) is not None:
            if self._tries.promised(found):
                return found
        return None

    def hopeful(self, sets: Sequence[Counts]) -> Counts | None:
        """Return the smallest fleet that leaves hope; None: there is none."""
        found = set[Counts]()
        for first in sets:
            enough = self._grown(first)
            if enough is not None:
                used = [place for place, count in enumerate(first) if count]
                orders = list(permutations(used))[:_MOST_ORDERS]
                found |= {self.reduced(enough, order) for order in orders}
        return min(found, key=lambda counts: (sum(counts), counts), default=None)

    def _holds(self, counts: Counts) -> bool:
        there = self._stock.of(counts) is not None
        return there and self._able(counts) and self._tries.hopeful(counts)

    def _able_sets(self) -> Iterator[Counts]:
        """Yield the least sets of categories that can do all trips, with few drones of each.

        All categories are the last one, since hooks may add trips that only others can do.
        """
        found: list[frozenset[int]] = []
        kinds = range(len(self._stock.kinds))
        for size in range(1, len(kinds) + 1):
            for chosen in map(frozenset, combinations(kinds, size)):
                if size == len(kinds) or not any(known <= chosen for known in found):
                    first = self._first_able(chosen)
                    if first is not None:
                        found.append(chosen)
                        yield first

    def _first_able(self, chosen: frozenset[int]) -> Counts | None:
        """Return the fewest drones of these categories that can: not every home is near enough."""
        one: Counts = tuple(int(place in chosen) for place in range(len(self._stock.kinds)))
        return next(filter(self._able, self._multiples(one)), None)

    def _multiples(self, first: Counts) -> Iterator[Counts]:
        number = 1
        while self._stock.of(counts := tuple(number * count for count in first)) is not None:
            yield counts
            number += 1

    def _grown(self, first: Counts) -> Counts | None:
        """Return a multiple of a fleet that holds: of its doubles, or else near the best of them."""
        all_: list[Counts] = list(self._multiples(first))
        doubled = [(1 << power) - 1 for power in range(len(all_).bit_length())]
        tried = list(dict.fromkeys([*doubled, len(all_) - 1]))
        for place in tried:
            if self._holds(all_[place]):
                return all_[place]
        if self._in_vain(all_[-1]):
            rest = (one for one in all_[:_MOST_SIZES] if not self._in_vain(one))
            return next(filter(self._holds, rest), None)
        best = max(range(len(tried)), key=lambda which: self._rate(all_[tried[which]]))
        near = tried[max(0, best - 1) : best + 2]
        between = (
            all_[place]
            for low, high in pairwise(near)
            if self._rate(all_[low]) != self._rate(all_[high])  # else it makes no difference
            for place in range(low + 1, high)
        )
        return next(filter(self._holds, between), None)

    def _rate(self, counts: Counts) -> float:
        tally = self._tries.tallies.get(counts)
        return tally.succeeded / len(tally.runs) if tally is not None else 0.0

    def reduced(self, counts: Counts, order: Sequence[int]) -> Counts:
        """Return a fleet from which no drone can be taken away, nor two exchanged for one."""
        for place in order:
            counts = self._halved(counts, place)
        while smaller := next(filter(self._holds, _neighbours(counts, order)), None):
            counts = smaller
        return counts

    def _halved(self, counts: Counts, place: int) -> Counts:
        bad, good = -1, counts[place]
        while good - bad > 1:
            middle = (bad + good) // 2
            if self._holds(_with(counts, place, middle)):
                good = middle
            else:
                bad = middle
        return _with(counts, place, good)


def _neighbours(counts: Counts, order: Sequence[int]) -> Iterator[Counts]:
    for fewer in range(1, _LOOK_BELOW + 1):
        for place in order:
            if counts[place] >= fewer:
                yield _with(counts, place, counts[place] - fewer)
    for place in order:
        for other in order:
            if other != place and counts[place] >= 2:
                less = _with(counts, place, counts[place] - 2)
                yield _with(less, other, counts[other] + 1)


def _with(counts: Counts, place: int, count: int) -> Counts:
    return (*counts[:place], count, *counts[place + 1 :])
