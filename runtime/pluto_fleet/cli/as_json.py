"""What a flown plan is to another program: plain data, numbers with three decimals."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.session import Outcome


def outcome_data(name: str, seed: int, outcome: Outcome) -> dict[str, object]:
    """Return the object that `simulate --json` prints."""
    return {
        "app": name,
        "seed": seed,
        "duration_s": outcome.duration,
        "missions": [
            {
                "name": mission.name,
                "status": mission.status.value,
                "reason": mission.reason,
                "completed_trips": [trip.name for trip in mission.completed_trips],
                "rounds": mission.round + 1,
                "attempts": mission.attempts,
            }
            for mission in outcome.missions
        ],
        "trips": trips_data(outcome),
        "drones": [
            {
                "id": drone.id,
                "trips": drone.trips,
                "flown_m": outcome.flown[drone.id],
                "battery_level": drone.battery_level,
                "status": drone.status.value,
            }
            for drone in outcome.drones
        ],
        "log": outcome.log,
        **({"crashed_drones": outcome.crashed} if outcome.crashed else {}),
        **({"given_up": outcome.given_up} if outcome.given_up else {}),
    }


def trips_data(outcome: Outcome) -> dict[str, int]:
    """Return how many flights there were, and how they ended."""
    return {
        "completed": outcome.count("trip.completed"),
        "failed": outcome.count("trip.failed"),
        "attempts": outcome.count("trip.launched"),
    }
