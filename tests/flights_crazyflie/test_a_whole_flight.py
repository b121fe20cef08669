"""An example flies Crazyflies through the unmodified cflib (they are simulated down to the radio)."""

from __future__ import annotations

from tests.flights_crazyflie.conftest import NewFlight
from tests.flights_crazyflie.judge import (
    astray,
    beside_its_target,
    dropped,
    left_in_the_air,
    nearest,
)
from tests.flights_crazyflie.plans import SIZE, WARD, fleet, missions, targets
from tests.kill.trial import gateway_of

APART = 0.5


def test_all_trips_are_completed_at_their_targets_and_every_drone_lands_before_its_link_closes(
    new_flight: NewFlight,
) -> None:
    flight = new_flight(missions(WARD), fleet(5), 5)
    flight.start()
    assert flight.wait() == 0, flight.told
    assert set(flight.ends().values()) == {"COMPLETED"}, flight.told
    flight.until(lambda: gateway_of(flight.journal) is None)  # all links are closed
    events, commands, trace = flight.events, flight.commands, flight.trace
    assert list(beside_its_target(events, trace, targets(WARD))) == []
    assert [*dropped(commands), *left_in_the_air(commands), *astray(commands, SIZE)] == []
    least, who = nearest(trace)
    assert least > APART, who
