"""What goes wrong on a flight is drawn: how often, when, and on what it depends."""

from __future__ import annotations

from random import Random

import pytest

from pluto_fleet.shared.alone.world import Faults, draw
from pluto_fleet.shared.domain.errors import Failure


def test_faults_fire_as_often_as_they_should() -> None:
    """Of many flights the asked share goes wrong, at moments all over the flight."""
    faults = Faults(crash=0.3, link=0.1, action=0.2, battery=0.05)
    drawn = [draw(faults, 1, f"m/t/0/{i}", 100.0) for i in range(5000)]
    crashes = [each[Failure.CRASH] for each in drawn if Failure.CRASH in each]
    assert len(crashes) == pytest.approx(1500, rel=0.1)
    assert sum(Failure.LINK in each for each in drawn) == pytest.approx(500, rel=0.15)
    assert sum(Failure.BATTERY in each for each in drawn) == pytest.approx(250, rel=0.25)
    assert sum(Failure.ACTION in each for each in drawn) == pytest.approx(1000, rel=0.1)
    assert min(crashes) < 2
    assert 98 < max(crashes) <= 100
    assert sum(crashes) / len(crashes) == pytest.approx(50, rel=0.05)


def test_what_goes_wrong_depends_on_the_flight_alone() -> None:
    """Another probability, or another flight before, changes nothing; another seed does."""
    alone = draw(Faults(link=0.5), 3, "m/t/0/1", 15.0)
    assert (
        draw(Faults(link=0.5, crash=1, battery=1), 3, "m/t/0/1", 15.0)[Failure.LINK]
        == alone[Failure.LINK]
    )
    Random(3).random()
    assert draw(Faults(link=0.5), 3, "m/t/0/1", 15.0) == alone
    assert draw(Faults(crash=1), 3, "m/t/0/1", 15.0) != draw(Faults(crash=1), 4, "m/t/0/1", 15.0)
    assert draw(Faults(), 3, "m/t/0/1", 15.0) == {}
