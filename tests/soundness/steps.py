"""What a block does with a mission: every outcome that it can have."""

from __future__ import annotations

from collections.abc import Iterator

from tests.soundness.app import Block
from tests.soundness.kinds import FIVE, MONITORS, C, F, R, S, Status, U
from tests.soundness.state import State, Token, Verdict, Wrong

MOST_TRIPS = 3


def outcomes(
    state: State,
    token: Token,
    block: Block,
    *,
    strict: bool,
    most_flights: int,
    unlike: bool = False,
) -> Iterator[tuple[Status, State]]:
    """Yield every status with which the mission can leave a block now, and what has become of it."""
    match block.kind:
        case "MissionCreator":
            yield U, state
        case "DroneAllocator":
            yield (S if token.status == F else token.status), state._replace(drone=True)
        case "TripLauncher":
            yield R, launched(state, block, most_flights)
        case kind if kind in MONITORS:
            if state.flight is None:
                raise Wrong(Verdict.NO_LAUNCH, block.name)
            if state.flight != R:
                yield state.flight, state
        case "MissionRepeater":
            if not state.over:
                yield from ((S, with_trips(state, trips)) for trips in (1, MOST_TRIPS))
            yield C, state._replace(over=True)
        case "MissionEvaluator":
            state = state._replace(over=False)
            yield from ((S, with_trips(state, trips)) for trips in (1, MOST_TRIPS))
            yield from ((C, state), (F, state))
        case "PriorityManager":
            yield from (
                (status, state) for status in retried(state, block, by_count=strict or not unlike)
            )
        case "MissionModifier" if block.emits:
            state = state._replace(over=False)
            for status, after in modified(state, token, block, strict):
                early = status == F != token.status and state.flight == F
                # a trip that fails again before it is launched again was tried once more
                yield status, after._replace(flown=tried(after, most_flights)) if early else after
        case "MissionModifier":
            yield token.status, state._replace(over=False)
        case _:
            yield token.status, state


def launched(state: State, block: Block, most_flights: int) -> State:
    if not state.drone:
        raise Wrong(Verdict.NO_DRONE, block.name)
    return state._replace(
        drone=False,
        flight=R,
        trips=max(state.trips, 1),
        flown=tried(state, most_flights),
    )


def tried(state: State, most_flights: int) -> int:
    """Count one more flight; beyond the highest limit of the graph it makes no difference."""
    return min(state.flown + 1, most_flights)


def landed(state: State) -> Iterator[State]:
    """Yield every end that the trip in flight can have."""
    left = state.trips - 1
    yield state._replace(flight=S if left else C, trips=left, flown=0)
    yield state._replace(flight=F)


def with_trips(state: State, trips: int) -> State:
    return state._replace(trips=trips, flown=0)


def retried(state: State, block: Block, *, by_count: bool) -> tuple[Status, ...]:
    """Return what a retry may say; where several have unlike bounds, one of them can keep another
    from ever giving up: that is beyond what has to be seen."""
    if not block.limit:
        return (S,)
    if state.flight != F or (
        state.flown < block.limit and not by_count
    ):  # somebody else judged it a failure
        return (S, F)
    return (F,) if state.flown >= block.limit else (S,)


def modified(
    state: State, token: Token, block: Block, strict: bool
) -> Iterator[tuple[Status, State]]:
    """Yield what a hook may say; a hook that says what is not so ends its mission at once.

    A hook can also put trips back or take them away, and so make true what was not. How far is not
    settled; the strict reading is that it does not.
    """
    for status in FIVE:
        if status not in block.emits:
            continue
        if status == F and state.flight == R:
            yield F, state._replace(flight=F)
        elif may_be(status, state, token, strict):
            yield status, state


def may_be(status: Status, state: State, token: Token, strict: bool) -> bool:
    """Say whether a hook may send a mission on with this status."""
    if status not in (S, C):
        return True
    if state.flight == R:
        return False
    if not strict or status in (state.flight, token.status):
        return True
    return status == S and token.status == U
