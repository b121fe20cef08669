"""An action of the app's own: done by its hook, while the drone hovers at the trip's target."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from ..domain.actions import Action
from ..domain.errors import ActionFailed, Failure, FlightFailed, HookFault
from ..domain.guard import NOT_ITS_OWN
from ..domain.keeper import reading
from ..domain.model import Photo
from ..domain.plain import as_a, plain_of
from ..domain.text import LONGEST_REASON, bounded, class_of, shown, text_of
from ..fleet.reach import needed
from ..hooks.calls import Hook, call_hook, fault_of, trace_of
from ..hooks.context import Context, LiveDrone, can_wait
from ..hooks.plain_data import keepable
from ..time.kernel import EventKind, Future
from .asking import kept_by, take_over

if TYPE_CHECKING:
    from ..domain.model import Drone
    from ..time.kernel import Key
    from .flight import Flight
    from .mission import Core, MissionState

NO_MORE = "battery: what is left of it only just suffices for the way home"
NEAR = 2.0  # seconds before a battery only just suffices from when on it is asked exactly then
MOMENT = 0.01  # seconds by which sums of floats may be off, and more


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnAction(Action):
    """An action of the app's own, done by its hook."""

    returns: type[object] | None = None
    """The type of all that its hook gives; None: it may give anything."""

    async def act(self, state: MissionState, flight: Flight) -> None:
        """Call the hook, and complete or fail the flight by its outcome."""
        try:
            value = self._checked(await self._value(state, flight))
        except FlightFailed as error:
            state.fail(flight, str(error))
        except HookFault as fault:
            state.core.log(fault.detail, state.mission.name)
            state.fail(flight, str(fault), mends=False)
        else:
            state.complete(flight, keepable(value))

    def _checked(self, value: object) -> object:
        """Return a result as one of the type that is declared; any other is a fault of the hook."""
        if self.returns is None:
            return value
        plain = as_a(self.returns, value)
        if self.returns is Photo and type(value) is Photo:
            plain = value
        if plain is None:
            wanted = f"hook {self.name} must return {_SAID[self.returns]}"
            reason = f"{wanted}, not {_given(value)}"
            raise HookFault(reason, reason)
        return plain

    async def _value(self, state: MissionState, flight: Flight) -> object:
        """Return the hook's result; raise `FlightFailed` if it or the drone fails."""
        core = state.core
        mission = state.mission
        trip = flight.trip
        drone = flight.flier
        hook = self.hook
        kernel = core.kernel
        key = state.key
        assert hook is not None
        flight.begun = True
        core.transitions.begin_action(mission, trip, drone)
        if core.on_record is not None:
            await core.on_record()
        live = LiveDrone(kernel, core.orders, drone, key) if can_wait(hook) else None
        new_context = core.context or Context
        context = new_context(kernel, core.results, core.log, mission, lambda: state.flight, live)
        call = _call(state, hook, drone, trip, context, **trip.parameters)
        work = state.spawn(call, f"{mission.name}: {self.name}")
        hover = state.spawn(core.orders.ask("hold", drone.id), f"{drone.id} hovers")
        until = kernel.now + self.lasts(trip.parameters)
        suffices = while_it_suffices(core, drone, state.key, until)
        rest = state.spawn(suffices, f"{drone.id}'s battery")
        over = Future[None]()
        began = kernel.now
        for task in (work, hover, rest):
            task.watch(over.set)
        try:
            await over
            if kernel.now == began and not hover.is_set:
                # whether the drone can hover is told at this instant, after the order to do so
                await kernel.sleep(0.0, EventKind.FLIGHT, key)
            if hover.is_set:
                hover.result()  # raises what went wrong with the drone
            if rest.is_set and not work.is_set:
                raise ActionFailed(NO_MORE)
            value = work.result()
        except ActionFailed as error:
            why = bounded(text_of(error) or "it does not say why", LONGEST_REASON)
            raise FlightFailed(Failure.ACTION, f"{self.name} failed: {why}") from error
        finally:
            for task in (work, hover, rest):
                task.cancel()
            if live is not None:
                live.release()
        return value

    async def was_done(self, state: MissionState, flight: Flight) -> bool | None:
        """Ask the hook that can tell whether it was done: `pollinate` has `pollinate_done`."""
        core = state.core
        name = f"{self.name}_done"
        assert self.hook is not None
        if name in core.app.actions or name in core.app.evaluators:
            return None  # something else has this name
        probe: Hook | None = getattr(sys.modules.get(self.hook.__module__), name, None)
        if probe is None:
            return None
        try:
            answer = await call_hook(core.kernel, reading(), probe, flight.flier, flight.trip)
        except NOT_ITS_OWN:
            raise
        except BaseException as error:  # noqa: BLE001 - it cannot tell: a person must
            core.log(trace_of(error), state.mission.name)
            return None
        return as_a(bool, answer)


async def _call(state: MissionState, hook: Hook, /, *args: object, **named: object) -> object:
    """Call an action; all that it raises, `ActionFailed` aside, is a fault of the hook."""
    try:
        with kept_by(state.mission).opened() as context:
            return await call_hook(state.core.kernel, context, hook, *args, **named)
    except (ActionFailed, *NOT_ITS_OWN):
        raise
    except BaseException as error:
        raise fault_of(hook, error) from error
    finally:
        take_over(state, hook)


def way_home(core: Core, drone: Drone) -> float:
    """Return the share of its battery that a drone needs home from where it is; infinite: no way leads there."""
    return needed(drone.category, core.airspace, drone.location, (), drone.home)


async def while_it_suffices(core: Core, drone: Drone, key: Key, until: float = -inf) -> None:
    """Wait while the battery of a hovering drone holds more than the way home and its reserve take.

    Until then, for as long as plans reckon with, half of the reserve will do: it is there for chance and traffic.
    """
    kernel = core.kernel
    category = drone.category
    way = way_home(core, drone)
    if way == inf:
        await Future[None]()  # no rest suffices where no way leads home
        return
    while True:
        left = until - kernel.now
        reserve = category.reserve / 2 if left > 0.0 else category.reserve
        rest = (drone.battery_level - way - reserve) * category.endurance
        if rest <= 0.0:
            return
        # a real battery may drain faster than its model: it is asked again half-way
        seconds = rest / 2 if rest > NEAR else rest + MOMENT
        if 0.0 < left < seconds:
            seconds = left
        await kernel.sleep(seconds, EventKind.ALLOCATE, key)


def _given(value: object) -> str:
    if value is None:
        return "None"
    is_odd = type(plain_of(value)) in (int, float) and as_a(float, value) is None
    why = "not finite, or too large" if is_odd else class_of(value)
    return f"{bounded(shown(value), 100)}, which is {why}"


_SAID: dict[type[object], str] = {
    bool: "True or False",
    int: "a whole number",
    float: "a number",
    str: "a text",
    Photo: "a Photo",
}
