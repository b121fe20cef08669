"""The station: its flight, its commands, and its data for pages."""

from __future__ import annotations

import asyncio
import secrets
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ..files.fleet import with_joined
from ..flight.commands import perform
from ..flight.config import End, FlightSetup
from ..flight.kept_events import record_event
from ..flight.lives import flight_of, reopen
from ..flight.offline import clear_stop, record_loss
from ..flight.recorded_flight import RecordedFlight
from ..gateway.starting import cut_directly, let_end, still_runs, stop_directly
from ..jobs.reports import Down
from ..journal import lock, place
from ..journal.header import header
from ..journal.standing import Standing, inherited
from ..journal.store import Store
from ..process.at_once import at_once
from ..process.ipc import NoAnswer, NotRunning
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted
from .attention import FILE as ALERTS
from .attention import Attention
from .between_flights import FleetHistory, put_away, unfinished_flight
from .config import described
from .map.drawn import DrawnMap, DrawnWays
from .plan.kept import PlanLibrary
from .plan.plan import FlightChanges
from .plan.problems import broken, promised
from .preflight.preflight import StartForecasts
from .results.exports import CurrentFlight, Exports
from .session import FlightSession, Phase, phase_of
from .updates import Updates

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
    from ..flight.live_flight import LiveFlight
    from ..process.apart import Answers
    from ..shared.domain.model import Mission
    from ..shared.domain.trace import Event
    from .config import StationConfig
    from .flight_files import FlightFiles
    from .plan.plan import MissionPlan
    from .preflight.preflight import PlannedStart
    from .wire import Forecast

ANSWERS_KEPT = 1_000
"""The number of commands whose answers are kept, in case they are repeated."""

GATEWAY_ANSWERS_WITHIN = 5.0
"""The time-out of a gateway without a brain, in seconds."""

LOOK_EVERY = 0.1
"""The polling interval of its end, in seconds."""


class Station:
    """One app with its fleet, its plan, and its flight."""

    def __init__(
        self,
        app: App,
        config: StationConfig,
        plan: MissionPlan,
        files: Answers[FlightFiles],
    ) -> None:
        """`files` reads the files of flights in the folder."""
        self._app, self._config, self.plan = app, config, plan
        self.map = DrawnMap(config.fleet.airspace, config.map_path)
        self.map.changed = self._describe
        self.plan.landmarks = self.map.landmarks
        self.ways = DrawnWays(app, config.fleet.airspace)
        self.library = PlanLibrary(config.own_folder / "plans", plan.saved)
        self.changes = FlightChanges(app, plan, self._commandable)
        self.fleet = config.fleet
        """The fleet, with the drones that have joined it."""
        self.described = described(app, config, self.map, secrets.token_hex(8))
        self.session: FlightSession | None = None
        self.leaves = asyncio.Event()
        """Set when the station is to end and nothing flies any more."""
        self.attention = Attention(config.own_folder / ALERTS, time.time)
        self._leaving = False
        self._answers: OrderedDict[str, asyncio.Future[str]] = OrderedDict()
        self._updates = Updates(self)
        self._watching: asyncio.Future[None] | None = None
        """Samples the flight while it lives."""
        self._one_at_a_time = asyncio.Lock()
        self.history = FleetHistory(app, config)
        """The drones' states while there is no flight."""
        self._forecasts = StartForecasts(
            app, config, plan, self.history, lambda: self.fleet, self._may_start
        )
        self.files = files
        self.exports = Exports(config, files, self._flight_now)
        self._before: Path | None = None
        """The folder of the last discarded flight's gateway, whose drones may still be landing."""

    def _describe(self) -> None:
        """Give all pages the map and the fleet as they are now, and the map's names to new plans."""
        config, server = replace(self._config, fleet=self.fleet), self.described["server"]
        self.described = described(self._app, config, self.map, server)
        self.plan.landmarks = self.map.landmarks

    @property
    def phase(self) -> Phase:
        """The present phase."""
        return phase_of(self.session)

    @property
    def _known(self) -> Standing | None:
        return self.session.known if self.session is not None else None

    def begin(self, going_on: bool = False) -> None:
        """Show the unfinished flight of an earlier station or of `fly`, if any."""
        self.history.read()
        taken = unfinished_flight(self._app, self._config, going_on)
        if taken is None:
            if self.history.flown_elsewhere() is None:
                self.plan.unlock()
            return
        self.session = self._session_of(taken.flight(self._config.speed))
        self.session.read(taken.records)
        if taken.is_over:
            self.session.end = End.OVER
        taken.store.close()
        self._lock_what_flies()

    # Commands

    async def command(self, name: str, id: str, given: Mapping[str, Any], by: str = "") -> str:
        """Carry out a command, once; return what was done, or raise `BadInput`.

        It is idempotent: a command that is repeated with the same id gets the same answer. `by` is
        the name of the person who gives it, if that is known. What is given has been checked.
        """
        if id in self._answers:
            return await asyncio.shield(self._answers[id])
        known = self._known
        if known is not None and id in known.commands:
            return "done already"
        answer = asyncio.ensure_future(self._do(name, id, given, by))
        self._answers[id] = answer
        answer.add_done_callback(_heard)
        if name == "raise-event":  # its id is the event's, which may happen when it can
            answer.add_done_callback(partial(self._forget_refusal, id))
        while len(self._answers) > ANSWERS_KEPT and next(iter(self._answers.values())).done():
            self._answers.popitem(last=False)
        return await asyncio.shield(answer)  # it is completed even if the page disconnects

    def _forget_refusal(self, id: str, answer: asyncio.Future[str]) -> None:
        if not answer.cancelled() and answer.exception() is not None:
            self._answers.pop(id, None)

    async def _do(self, name: str, id: str, given: Mapping[str, Any], by: str) -> str:
        match name:
            case "stop":
                return await self._stop(Down(given["how"]))
            case "cut-motors":
                return await self._cut_motors(given["drone"])
            case "start":
                async with self._one_at_a_time:
                    return await self._start(id, given, by)
            case "resume":
                async with self._one_at_a_time:
                    return self.resume()
            case "bring-back" if self.session is None or not self.session.lives:
                async with self._one_at_a_time:
                    return self._bring_back(id, given["drone"])
            case "raise-event" if self.phase in (Phase.STOPPED, Phase.INTERRUPTED):
                async with self._one_at_a_time:
                    return self._keep_event(id, given)
            case "acknowledge":
                return self.attention.acknowledge(given["alert"], by)
            case "discard":
                async with self._one_at_a_time:
                    return await self._discard()
            case "change-trips":
                return await self.changes.change_trips(id, given)
            case _:
                return await self._of_the_flight(name, id, given)

    async def _start(self, id: str, given: Mapping[str, Any], by: str) -> str:
        await self.plan.examined()
        if self.session is None:
            self.begin()  # another process may have flown meanwhile
        await self._others_are_down()
        self._may_start()
        phase = self.phase
        only_failed = given["only_failed"] is True
        missions, keys = self.plan.launchable(given["missions"], only_failed)
        if not missions and phase is Phase.FLYING:  # another page was quicker
            return "every mission of the plan flies already"
        if not missions:
            raise BadInput("there is no mission yet: make one first")
        if given["revision"] not in (None, self.plan.revision):
            raise BadInput("the plan has changed meanwhile: look at it, and start again")
        text = self.plan.export_toml(keys, only_failed)
        # before anything flies: they may not be changed from now on
        self.plan.launched(keys, only_failed)
        held_to = promised(missions)
        try:
            if phase is Phase.FLYING:
                await self._carry_out(id, "start", lambda life: life.add(missions))
            else:
                await self._set_out(missions, text, by)
        except BaseException:
            self._lock_what_flies()
            raise
        impossible = await broken(held_to, self._app, self.fleet)
        if self.session is not None:
            for said in impossible:
                self.session.say(said)
        trips = sum(len(mission.trips) for mission in missions)
        again = f" with {counted(trips, 'trip')} still to do" if only_failed else ""
        left = self.history.lost if phase is not Phase.FLYING else ()
        without = f"; without {', '.join(left)}, lost until brought back" if left else ""
        late = "; not all will be in time: the console says why" if impossible else ""
        return f"{counted(len(missions), 'mission')} started{again}{without}{late}"

    async def forecast(self, asked: PlannedStart) -> Forecast:
        """Return what a Start would do; raise `BadInput` if the plan is another, or a newer one is asked for."""
        return await self._forecasts.ask(asked, self.session)

    def _may_start(self) -> None:
        """Raise `BadInput` if a Start is refused, whatever the plan says."""
        if self.phase is Phase.STOPPING:
            raise BadInput("the drones are coming down: wait until they are")
        if self.phase in (Phase.STOPPED, Phase.INTERRUPTED):
            raise BadInput("the last flight has not ended: resume it, or put it away")
        if self.phase is Phase.FLYING:
            return
        self.history.read()
        self.history.check_free()
        lost = self.history.lost
        if lost and len(lost) == len(self.history.fleet.drones):
            raise BadInput(
                "every drone is lost: look after one, put it into its dock, and bring it back first"
            )

    def _bring_back(self, id: str, drone: str) -> str:
        """Bring a drone back while nothing flies."""
        said = self.history.bring_back(id, drone)
        if self.session is not None:
            self.session.records = self.history.records
        return said

    def _keep_event(self, id: str, given: Mapping[str, Any]) -> str:
        """Keep an event until the flight is resumed."""
        if self.session is None or self.session.lives:
            raise BadInput("the flight is just being resumed: try again in a moment")
        return record_event(self._app, self.session.journal, given["event"], {**given, "id": id})

    def _lock_what_flies(self) -> None:
        """Lock the flight's missions in the plan, and no others."""
        known = self._known
        if self.session is None:
            self.plan.unlock()
        elif self.phase is Phase.OVER:
            self.plan.settle(self.session.ends, self.session.done)
        else:
            self.plan.adopt(self.session.names)
            for name, record in known.missions.items() if known is not None else ():
                if record["replanned"]:
                    self.plan.follow(name, record)
        self._know_the_fleet()

    def _know_the_fleet(self) -> None:
        """Draw for, and show, the drones that have joined, too."""
        known = self._known
        fleet = self.history.fleet
        if known is not None:
            own = {one.id for one in self._config.fleet.drones}  # it may be in the file by now
            joined = [one for one in known.joined if one["id"] not in own]
            fleet = with_joined(self._app, self._config.fleet, joined)
        if fleet.drones != self.fleet.drones:
            self.fleet = fleet
            self.plan.fly_with(fleet)
            self._describe()

    def _follow(self, event: Event) -> None:
        """Let the plan agree with the flight, whoever has commanded what has happened."""
        known = self._known
        if event["event"] == "drone.joined":
            self._know_the_fleet()
        elif event["event"] == "mission.replanned" and known is not None:
            name = str(event["mission"])
            self.plan.follow(name, known.missions[name])

    async def _set_out(self, missions: list[Mission[Any]], text: str, by: str) -> None:
        config = self._config
        for index, mission in enumerate(missions):
            mission.index = index
        journal = place.new_in(config.folder, time.time())
        begun = header(
            self._app,
            missions=text,
            fleet=config.fleet_text,
            sim=config.sim,
            stand_ins=config.stand_ins.header if config.stand_ins else None,
            seed=config.seed,
            faults=config.faults,
            inherited=self.history.facts,
            by=by,
        )
        await asyncio.to_thread(self.history.hand_on_the_world, journal)
        store = Store.create(journal, begun)
        flight = flight_of(self._app, store, missions, config.fleet, config.speed or 1.0)
        self.session = self._session_of(flight, Standing(inherited(begun)))
        self._fly(self.session, store, None)

    def _session_of(self, flight: FlightSetup, known: Standing | None = None) -> FlightSession:
        return FlightSession(
            flight, self._over, self._updates.hurry, self._follow, known, self.map.name_of
        )

    def resume(self) -> str:
        """Resume a flight that was stopped or interrupted."""
        if self.phase is Phase.FLYING:
            return "it goes on already"
        if self.phase not in (Phase.STOPPED, Phase.INTERRUPTED) or self.session is None:
            raise BadInput("there is nothing to go on with")
        journal = self.session.journal
        taken = reopen(self._app, journal)
        clear_stop(taken.store.path)
        self.session.flight = taken.flight(self._config.speed)
        self._fly(self.session, taken.store, taken.records)
        return "going on where it was"

    def _fly(self, session: FlightSession, store: Store, records: Standing | None) -> None:
        """Let a flight begin, or go on, and be watched."""
        session.begin(store, records)
        self._watching = asyncio.ensure_future(self._updates.watch(session))

    async def _discard(self) -> str:
        if self.phase not in (Phase.STOPPED, Phase.INTERRUPTED) or self.session is None:
            raise BadInput("there is nothing to put away")
        elsewhere = lock.holder(self.session.journal)
        if elsewhere is not None:
            raise BadInput(
                f"it was gone on with elsewhere (process {elsewhere}): end it there first"
            )
        folder = place.gateway_folder(self.session.journal)
        with suppress(BadInput):  # the gateway has ended, as expected
            await asyncio.to_thread(stop_directly, folder, Down.LAND, GATEWAY_ANSWERS_WITHIN)
        let_end(folder)
        self._before = folder
        if self.session.records is not None:
            self.history.leave(self.session.journal, self.session.records)
        put_away(self._config, self.session.journal)
        self.plan.settle(self.session.ends, self.session.done)
        self.session = None
        return "put away; its journal is kept"

    async def _others_are_down(self) -> None:
        """Raise `BadInput` while an earlier gateway is still landing its drones."""
        if self._config.sim or self._before is None:
            return
        until = asyncio.get_running_loop().time() + GATEWAY_ANSWERS_WITHIN
        while still_runs(self._before) is not None:
            if asyncio.get_running_loop().time() > until:
                raise BadInput(
                    "the drones of the flight that was put away are still coming down:"
                    " start again when they are"
                )
            await asyncio.sleep(LOOK_EVERY)
        self._before = None

    async def _stop(self, how: Down) -> str:
        """Bring all drones down, without any delay."""
        session = self.session
        if session is None or not session.lives:
            return await self._stop_without_a_brain(how)
        if session.one is not None and session.life is not None:
            return await session.one.answer({"command": "stop", "how": how.value})
        session.stops.stop(how)
        return "stopping, as soon as the drones can be reached"

    async def _stop_without_a_brain(self, how: Down) -> str:
        """Bring the drones down by the gateway alone, as the app may have crashed."""
        if self.session is not None:
            folder = place.gateway_folder(self.session.journal)
            with suppress(BadInput):
                return await at_once(lambda: stop_directly(folder, how, GATEWAY_ANSWERS_WITHIN))
        return "nothing flies"

    async def _cut_motors(self, drone: str) -> str:
        """Switch a drone's motors off directly by the gateway."""
        if self.session is None:
            raise BadInput("nothing flies")
        folder = place.gateway_folder(self.session.journal)
        try:
            said = await at_once(lambda: cut_directly(folder, drone, GATEWAY_ANSWERS_WITHIN))
        except NotRunning:
            raise BadInput("nothing commands the drones now") from None
        except NoAnswer:
            raise BadInput("what commands the drones does not answer") from None
        if not self.session.lives:
            with suppress(BadInput):  # an app that flies it records that itself
                reason = f"{drone}'s motors were cut"
                record_loss(self._app, self.session.journal, drone, reason, None)
        return said

    async def _of_the_flight(self, name: str, id: str, given: Mapping[str, Any]) -> str:
        request = {"command": name, **given}
        if name == "raise-event":
            request["id"] = id  # with it the event, and not only the command, happens once
        await self._commandable().prepare(request)
        return await self._carry_out(id, name, lambda life: perform(life.control, request))

    async def _carry_out(
        self, id: str, name: str, do: Callable[[RecordedFlight], str | None]
    ) -> str:
        """Do something to the flight that is under way, and remember it as this command."""

        def done(life: RecordedFlight) -> str:
            said = do(life)
            life.control.remember(id, name)
            return said or ""

        return await self._commandable().carry_out(done)

    def _commandable(self) -> LiveFlight:
        """Return the run that can be commanded; raise `BadInput` if there is none."""
        session = self.session
        if session is None or not session.lives:
            held = self.phase in (Phase.STOPPED, Phase.INTERRUPTED)
            raise BadInput("nothing flies now" + (": resume the flight first" if held else ""))
        if session.one is None or session.life is None:
            raise BadInput(_NOT_YET)
        return session.one

    def leave(self) -> None:
        """End the station as soon as all drones have landed."""
        self._leaving = True
        if self.session is not None and self.session.lives:
            self.session.stops.stop(Down.LAND)
        else:
            self.leaves.set()

    def _over(self) -> None:
        """Called when nothing flies any more: unlock the plan, and end the station if it waits for that."""
        self._lock_what_flies()
        if self.session is not None and self.session.records is not None:
            self.history.leave(self.session.journal, self.session.records)
        try:
            self._updates.close()
        finally:  # an error of the display keeps nothing back
            if self._leaving:
                self.leaves.set()

    # What pages show

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        """Return the changes since a page's last update, as soon as there are any, or after a second."""
        return await self._updates.newer(flight, seen, log, results)

    def _flight_now(self) -> CurrentFlight | None:
        session = self.session
        if session is None:
            return None
        return CurrentFlight(
            flight=session.journal.stem, journal=session.journal, feed=session.feed
        )


_NOT_YET = "the drones are just being asked where they are: try again in a moment"


def _heard(answer: asyncio.Future[str]) -> None:
    """Retrieve an exception, as the page may have disconnected."""
    if not answer.cancelled():
        answer.exception()
