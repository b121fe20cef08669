"""An action of the app's own: done by its hook, while the drone hovers at the trip's target."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..domain.errors import ActionFailed, Failure, FlightFailed
from ..domain.text import bounded, text_of
from ..hooks.calls import LONGEST_REASON, Held, Hook, call_action, changed
from ..time.future import Future

if TYPE_CHECKING:
    from ..fleet.navigation import Navigation
    from ..hooks.context import Context
    from ..time.kernel import Kernel, Key
    from .flight import Flight


async def done_while_hovering(
    kernel: Kernel,
    navigation: Navigation[Any],
    flight: Flight,
    hook: Hook,
    context: Context,
    key: Key,
) -> object:
    """Return what the hook gives; raise `FlightFailed` where it or the drone fails."""
    trip, drone = flight.trip, flight.flier
    called = f"{flight.mission.name}: {trip.action}"
    call = call_action(kernel, hook, drone, trip, context, **trip.parameters)
    work = kernel.spawn(call, key, called)
    hover = kernel.spawn(navigation.hold(drone.id), key, f"{drone.id} hovers")
    held = Held(trip, "name", "action", "item", "index", "attempt", "status")
    over: Future[None] = Future()
    work.watch(over.set)
    hover.watch(over.set)
    try:
        await over
        if hover.is_set:
            hover.result()  # raises what went wrong with the drone
        value = work.result()
    except ActionFailed as error:
        why = bounded(text_of(error) or "it does not say why", LONGEST_REASON)
        raise FlightFailed(Failure.ACTION, f"{trip.action} failed: {why}") from error
    finally:
        fact = held.put_back() if work.is_set else ""  # it may have been called off
        work.cancel()
        hover.cancel()
        context.release_drone()
    if fact:
        raise changed(hook, "trip", fact)
    return value
