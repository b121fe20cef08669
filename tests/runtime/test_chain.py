"""A chain keeps things in the order in which they came."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc_runtime.time.kernel import Chain


class Thing:
    """What can be in a chain."""

    before: object
    after: object

    def __init__(self) -> None:
        self.before = self.after = None


@settings(derandomize=True)
@given(st.lists(st.integers(0, 8)))
def test_when_some_come_and_go_the_others_stay_in_their_order(moves: Sequence[int]) -> None:
    """As in a dict; who has left may leave once more, and come again."""
    things = [Thing() for _ in range(9)]
    chain, known = Chain[Thing](), dict[Thing, None]()
    for move in moves:
        thing = things[move]
        if thing in known:
            del known[thing]
            chain.remove(thing)
            chain.remove(thing)
        else:
            known[thing] = None
            chain.add(thing)
        assert (list(chain), len(chain)) == (list(known), len(known))


def test_all_may_leave_while_they_are_looked_at() -> None:
    chain, things = Chain[Thing](), [Thing() for _ in range(3)]
    for thing in things:
        chain.add(thing)
    for thing in chain:
        chain.remove(thing)
    assert not list(chain)
