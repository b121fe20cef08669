"""What a block does with a mission: every outcome that it can have."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tests.soundness.app import Block
from tests.soundness.kinds import FIVE, MONITORS, NEED_A_TRIP, C, F, R, S, Status, U
from tests.soundness.state import State, Token, Verdict, Wrong

MOST_TRIPS = 3


def outcomes(
    state: State, token: Token, block: Block, *, strict: bool, most_flights: int
) -> Iterator[tuple[Status | None, State]]:
    """Yield every status with which the mission can leave a block now, and what has become of it.

    With None it ends right there, and no arrow is asked.
    """
    match block.kind:
        case "MissionCreator":
            yield U, state
        case kind if kind in NEED_A_TRIP and state.spent:
            yield None, state
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
            if (block.name, C) not in state.said:
                yield from ((S, with_trips(state, trips)) for trips in (1, MOST_TRIPS))
            yield C, having_said(state, block, C)
        case "MissionEvaluator":
            before = dict(state.said).get(block.name)
            for status in (S, C, F) if before is None else (before,):
                after = having_said(state, block, status)._replace(spent=status == F)
                for trips in (1, MOST_TRIPS) if status == S else (0,):
                    yield status, with_trips(after, trips) if trips else after
        case "PriorityManager":
            for status in retried(state, block, by_count=strict):
                bound = max(state.given_up, block.limit) if status == F else state.given_up
                yield status, state._replace(given_up=bound)
        case "TripSkipper":
            left = max(state.trips, 1) - 1
            yield (S if left else C), with_trips(state, left)
        case "MissionModifier" if block.emits:
            for status, after in modified(state, token, block, strict):
                # of a mission that another branch has failed it knows nothing
                spent = after.spent and F not in (status, token.status)
                yield status, after._replace(spent=spent)
        case _:
            yield token.status, state


def hooks_fail(
    state: State, token: Token, block: Block, ways: Sequence[tuple[Status | None, State]]
) -> tuple[Status, ...]:
    """Return the statuses by which a hook would fail a mission that has nothing left to fly, for no
    need: it could leave it as it is. To say that it flies, or has never flown, is a fault."""
    if not state.idle or not (block.emits or block.kind == "MissionEvaluator"):
        return ()
    if token.status != C and not state.spent:
        return ()  # a hook failed it, which may have put trips back
    could = {status for status, _ in ways if status in (S, C)}
    return (F, R, U) if could else ()


def having_said(state: State, block: Block, status: Status) -> State:
    said = {**dict(state.said), block.name: status}
    return state._replace(said=tuple(sorted(said.items())))


def launched(state: State, block: Block, most_flights: int) -> State:
    if not state.drone:
        raise Wrong(Verdict.NO_DRONE, block.name)
    return state._replace(
        drone=False,
        flight=R,
        trips=max(state.trips, 1),
        said=(),
        given_up=0,
        spent=False,
        flown=tried(state, most_flights),
        before=state.flown,
    )


def tried(state: State, most_flights: int) -> int:
    """Count one more flight; beyond the highest limit of the graph it makes no difference."""
    return min(state.flown + 1, most_flights)


def landed(state: State) -> Iterator[State]:
    """Yield every end that the trip in flight can have."""
    left = state.trips - 1
    yield state._replace(flight=S if left else C, trips=left, flown=0)
    yield state._replace(flight=F)


def broken_off(state: State) -> State:
    """Return the state when an event has broken the flight off: its trip is next, and was not charged."""
    return state._replace(flight=S, flown=state.before)


def with_trips(state: State, trips: int) -> State:
    return state._replace(trips=trips, flown=0, given_up=0)


def retried(state: State, block: Block, *, by_count: bool) -> tuple[Status, ...]:
    """Return what a retry may say; where it does not count, it may give up sooner. How often a trip has
    been flown on a way is beyond what has to be seen: one retry can keep another from ever giving up.
    """
    if not block.limit:
        return (S,)
    if state.given_up >= block.limit or (state.flight == F and state.flown >= block.limit):
        return (F,)
    judged = state.flight != F  # it did not fail in flight: a hook said so
    return (S, F) if judged or not by_count else (S,)


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
            if not strict:
                yield from ((status, then) for then in changed(status, state))


def changed(status: Status, state: State) -> Iterator[State]:
    """Yield what a mission may have become whose trips a hook has changed, if it says this then."""
    if state.flight == R:
        return
    if status == C and state.trips:
        yield with_trips(state, 0)
    elif status in (S, F, U):
        yield with_trips(state, max(state.trips, 1))  # another trip first, or one that was put back


def may_be(status: Status, state: State, token: Token, strict: bool) -> bool:
    """Return whether a hook may send a mission on with this status."""
    if status not in (S, C):
        return True
    if state.flight == R:
        return False
    if not strict:
        return True
    if (status == S) != bool(state.trips):
        return False
    return status in (state.flight, token.status) or (status == S and token.status == U)
