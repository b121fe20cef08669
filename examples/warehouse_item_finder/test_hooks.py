"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py warehouse_item_finder/tests/"""

from __future__ import annotations

from warehouse_item_finder import hooks
from warehouse_item_finder.testing import Kit


def test_a_lifter_is_sent_where_no_other_is_free(kit: Kit) -> None:
    trip, lifter = kit.trip(target=(5.0, 5.0, 1.0)), kit.drone("lifter", at=(5.0, 5.0, 0.0))
    light = kit.drone("light", at=(9.0, 9.0, 0.0))
    assert hooks.weakest_first(trip, [lifter, light]) is light
    assert hooks.weakest_first(trip, [lifter]) is lifter


def test_of_equals_the_nearest_is_sent(kit: Kit) -> None:
    trip = kit.trip(target=(5.0, 5.0, 1.0), source=(1.0, 1.0, 1.0))
    far, near = (kit.drone("light", at=(x, x, 0.0)) for x in (5.0, 2.0))
    assert hooks.weakest_first(trip, [far, near]) is near, "the way begins at the source"


def test_of_the_very_same_the_first_of_the_fleet_is_sent(kit: Kit) -> None:
    first, second = kit.drone("light"), kit.drone("light")
    assert hooks.weakest_first(kit.trip(), [second, first]) is first
