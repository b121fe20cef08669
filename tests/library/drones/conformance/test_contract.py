"""The kit finds what is wrong with a navigation, by the check that is named after it; a right one passes."""

from __future__ import annotations

from collections.abc import Iterator
from unittest import SkipTest

import pytest

from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.protocol import DroneNavigation
from tests.kit.drones import FakeDrone, JumpingLoop
from tests.library.drones.conformance.wrong import FakeContract, Lingering, Wrong, all_wrong


@pytest.fixture(scope="module", autouse=True)
def threads_end() -> Iterator[None]:
    """What lingers goes when all is over."""
    yield
    Lingering.over.set()


class TestFake(FakeContract):
    """A fake drone does what it must."""


@pytest.mark.parametrize("wrong", all_wrong(), ids=lambda wrong: wrong.__name__)
def test_a_wrong_navigation_is_found_by_the_check_that_it_names(wrong: type[Wrong]) -> None:
    contract = type("Contract", (FakeContract,), {"navigation": wrong})()
    with pytest.raises(AssertionError) as found:
        getattr(contract, wrong.found_by)()
    assert wrong.says in str(found.value)


class Bare(NavigationContract):
    """An author who can neither silence a drone nor look at it."""

    loop_factory = JumpingLoop

    def make(self) -> DroneNavigation:
        return FakeDrone()


@pytest.mark.parametrize(
    ("check", "hook"),
    [
        ("test_a_drone_that_is_not_there_is_a_lost_link", "make_unreachable"),
        ("test_a_drone_that_falls_silent_is_a_lost_link", "silence"),
        ("test_a_drone_that_crashes_is_a_crash", "crash"),
        ("test_nothing_but_emergency_stop_cuts_the_motors", "may_fall"),
    ],
)
def test_what_cannot_be_tried_is_skipped_and_says_what_is_missing(check: str, hook: str) -> None:
    with pytest.raises(SkipTest, match=hook):
        getattr(Bare(), check)()


def test_an_author_who_gives_nothing_is_told_what_to_give() -> None:
    with pytest.raises(NotImplementedError, match="def make"):
        NavigationContract().test_telemetry_is_fresh()
