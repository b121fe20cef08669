"""The station: what flies, what everybody sees of it, and what may be commanded."""

from __future__ import annotations

import asyncio
import secrets
import time
from collections import OrderedDict
from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.faults import Faults
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import counted

from ..cli import stop_mark
from ..cli.flights import Flight
from ..cli.looked_after import lost_meanwhile
from ..cli.taken_up import take_up
from ..flight.commands import perform
from ..flight.config import End
from ..gateway.starting import cut_directly, let_end, still_runs, stop_directly
from ..jobs.reports import Down
from ..journal import lock, place
from ..journal.fold import Records
from ..journal.header import header
from ..journal.store import Store
from ..process.ipc import NoAnswer, NotRunning
from . import leftover
from .commands import checked
from .describe import described
from .inheritance import Inheritance
from .phase import Phase, phase_of
from .session import Outing
from .updates import Scene

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ..flight.recorded_flight import Life
    from .plan.plan import Plan
    from .settings import Settings

REMEMBERED = 1_000
"""Commands whose answers are known, if they are asked for once more."""

STOP_WITHIN = 5.0
"""Seconds for a gateway without a brain to answer."""

LOOK_EACH = 0.1
"""Seconds between two looks whether it has ended."""


class Station:
    """One app, its fleet, the plan that people draw, and what flies of it."""

    def __init__(self, app: App, settings: Settings, plan: Plan) -> None:
        self._app, self._settings, self.plan = app, settings, plan
        self.described = described(app, settings) | {"server": secrets.token_hex(8)}
        self.outing: Outing | None = None
        """What flies, or flew last."""
        self.leaves = asyncio.Event()
        """Set when nothing flies any more and somebody wants the station to end."""
        self._leaving = False
        self._answers: OrderedDict[str, asyncio.Future[str]] = OrderedDict()
        self._scene = Scene(self)
        self._one_at_a_time = asyncio.Lock()
        self.inheritance = Inheritance(app, settings)
        """What is known of the drones while there is no flight."""
        self._before: Path | None = None
        """The folder of the gateway that was put away last: its drones may still be coming down."""

    @property
    def image(self) -> Path | None:
        """The floor plan."""
        return self._settings.image

    @property
    def phase(self) -> Phase:
        """What goes on."""
        return phase_of(self.outing)

    def begin(self, going_on: bool = False) -> None:
        """Show the flight that an earlier station, or `fly`, has not brought to its end."""
        self.inheritance.read()
        taken = leftover.found(self._app, self._settings, going_on)
        if taken is None:
            if self.inheritance.flown_elsewhere() is None:
                self.plan.unlock()
            return
        self.outing = Outing(taken.flight(self._settings.speed), self._over, self._scene.hurry)
        self.outing.read(taken.known)
        if taken.is_over:
            self.outing.end = End.OVER
        taken.store.close()
        self._lock_what_flies()

    # What may be commanded

    async def command(self, name: str, id: str, given: Mapping[str, object]) -> str:
        """Do what somebody asks for, once; return what was done, or raise `BadInput`.

        Whoever asks again under the same name, having heard no answer, gets the answer of then.
        """
        arguments = checked(name, given)
        if id in self._answers:
            return await asyncio.shield(self._answers[id])
        if self._was_done(id):
            return "done already"
        answer = asyncio.ensure_future(self._do(name, id, arguments))
        self._answers[id] = answer
        answer.add_done_callback(_heard)
        while len(self._answers) > REMEMBERED and next(iter(self._answers.values())).done():
            self._answers.popitem(last=False)
        return await asyncio.shield(answer)  # whoever asked may go: it is done all the same

    def _was_done(self, id: str) -> bool:
        outing = self.outing
        if outing is None:
            return False
        return outing.known is not None and id in outing.known.commands

    async def _do(self, name: str, id: str, given: Mapping[str, object]) -> str:
        match name:
            case "stop":
                return await self._stop(Down(str(given["how"])))
            case "cut-motors":
                return await self._cut_motors(str(given["drone"]))
            case "start":
                async with self._one_at_a_time:
                    return await self._start(id, given)
            case "resume":
                async with self._one_at_a_time:
                    return self.resume()
            case "bring-back" if self.outing is None or not self.outing.lives:
                async with self._one_at_a_time:
                    return self._bring_back(id, str(given["drone"]))
            case "discard":
                async with self._one_at_a_time:
                    return await self._discard()
            case _:
                return await self._of_the_flight(name, id, given)

    async def _start(self, id: str, given: Mapping[str, object]) -> str:
        await self.plan.examined()
        if self.outing is None:
            self.begin()  # somebody else may have flown meanwhile
        phase = self.phase
        if phase is Phase.STOPPING:
            raise BadInput("the drones are coming down: wait until they are")
        if phase in (Phase.STOPPED, Phase.INTERRUPTED):
            raise BadInput("the last flight has not ended: resume it, or put it away")
        await self._others_are_down()
        if phase is not Phase.FLYING:
            self._look_at_the_drones()
        chosen = given["missions"]
        missions, keys = self.plan.launchable(chosen if isinstance(chosen, list) else None)
        if not missions and phase is Phase.FLYING:  # somebody else was quicker
            return "every mission of the plan flies already"
        if not missions:
            raise BadInput("there is no mission yet: make one first")
        if given["revision"] not in (None, self.plan.revision):
            raise BadInput("the plan has changed meanwhile: look at it, and start again")
        text = self.plan.text(keys)
        self.plan.launched(keys)  # before anything flies: nobody may change it from now on
        try:
            if phase is Phase.FLYING:
                await self._add(id, missions)
            else:
                await self._set_out(missions, text)
        except BaseException:
            self._lock_what_flies()
            raise
        left = self.inheritance.lost if phase is not Phase.FLYING else ()
        without = f"; without {', '.join(left)}, lost until brought back" if left else ""
        return f"{counted(len(missions), 'mission')} started{without}"

    def _look_at_the_drones(self) -> None:
        """Raise `BadInput` if none of them may fly."""
        self.inheritance.read()
        self.inheritance.check_free()
        lost = self.inheritance.lost
        if lost and len(lost) == len(self._settings.fleet.drones):
            raise BadInput(
                "every drone is lost: look after one, put it into its dock, and bring it back first"
            )

    def _bring_back(self, id: str, drone: str) -> str:
        """A person has looked after a drone, while nothing flies."""
        said = self.inheritance.bring_back(id, drone)
        if self.outing is not None:
            self.outing.records = self.inheritance.records
        return said

    async def _add(self, id: str, missions: list[Mission[Any]]) -> None:
        """Let missions set out beside those that fly."""
        one = self.outing.one if self.outing is not None else None
        if one is None:
            raise BadInput(_NOT_YET)

        def add(life: Life) -> str:
            life.add(missions)
            life.control.remember(id, "start")
            return ""

        await one.carry_out(add)

    def _lock_what_flies(self) -> None:
        """Let the missions that the flight has, and no others, be as they are in the plan."""
        if self.outing is None:
            self.plan.unlock()
        elif self.phase is Phase.OVER:
            self.plan.settle(self.outing.ends)
        else:
            self.plan.adopt(self.outing.names)

    async def _set_out(self, missions: list[Mission[Any]], text: str) -> None:
        settings = self._settings
        for index, mission in enumerate(missions):
            mission.index = index
        journal = place.new_in(settings.folder, time.time())
        begun = header(
            self._app,
            missions=text,
            fleet=settings.fleet_text,
            sim=settings.sim,
            crtp_sim=settings.crtp_sim,
            seed=settings.seed,
            faults=settings.faults,
            inherited=self.inheritance.facts,
        )
        await asyncio.to_thread(self.inheritance.hand_on_the_world, journal)
        store = Store.create(journal, begun)
        flight = Flight(
            app=self._app,
            journal=store.path,
            missions=missions,
            fleet=settings.fleet,
            speed=settings.speed or 1.0,
            seed=settings.seed,
            faults=Faults(**settings.faults),
            sim=settings.sim,
            crtp=settings.crtp_sim is not None,
        )
        known = Records()
        known.take(begun)
        self.outing = Outing(flight, self._over, self._scene.hurry, known)
        self.outing.begin(store, None)

    def resume(self) -> str:
        """Go on with what was stopped or interrupted."""
        if self.phase is Phase.FLYING:
            return "it goes on already"
        if self.phase not in (Phase.STOPPED, Phase.INTERRUPTED) or self.outing is None:
            raise BadInput("there is nothing to go on with")
        journal = self.outing.journal
        taken = take_up(self._app, journal)
        stop_mark.remove(taken.store.path)
        self.outing.flight = taken.flight(self._settings.speed)
        self.outing.begin(taken.store, taken.known)
        return "going on where it was"

    async def _discard(self) -> str:
        if self.phase not in (Phase.STOPPED, Phase.INTERRUPTED) or self.outing is None:
            raise BadInput("there is nothing to put away")
        elsewhere = lock.holder(self.outing.journal)
        if elsewhere is not None:
            raise BadInput(
                f"somebody has gone on with it elsewhere (process {elsewhere}): end it there first"
            )
        folder = place.gateway_folder(self.outing.journal)
        with suppress(BadInput):  # nothing flies any more, as it should be
            await asyncio.to_thread(stop_directly, folder, Down.LAND, STOP_WITHIN)
        let_end(folder)
        self._before = folder
        if self.outing.records is not None:
            self.inheritance.leave(self.outing.journal, self.outing.records)
        leftover.put_away(self._settings, self.outing.journal)
        self.plan.settle(self.outing.ends)
        self.outing = None
        return "put away; its journal is kept"

    async def _others_are_down(self) -> None:
        """Let no second gateway command drones that are still coming down by the one before."""
        if self._settings.sim or self._before is None:
            return
        until = asyncio.get_running_loop().time() + STOP_WITHIN
        while still_runs(self._before) is not None:
            if asyncio.get_running_loop().time() > until:
                raise BadInput(
                    "the drones of the flight that was put away are still coming down:"
                    " start again when they are"
                )
            await asyncio.sleep(LOOK_EACH)
        self._before = None

    async def _stop(self, how: Down) -> str:
        """Bring all drones down: nothing stands between this and the drones."""
        outing = self.outing
        if outing is None or not outing.lives:
            return await self._stop_without_a_brain(how)
        if outing.one is not None and outing.life is not None:
            return await outing.one.answer({"command": "stop", "how": how.value})
        outing.stops.stop(how)
        return "stopping, as soon as the drones can be reached"

    async def _stop_without_a_brain(self, how: Down) -> str:
        """The app may have crashed, and its gateway may be bringing the drones down."""
        if self.outing is not None:
            folder = place.gateway_folder(self.outing.journal)
            with suppress(BadInput):
                return await asyncio.to_thread(stop_directly, folder, how, STOP_WITHIN)
        return "nothing flies"

    async def _cut_motors(self, drone: str) -> str:
        """Let the gateway switch a drone's motors off, whatever the app does meanwhile."""
        if self.outing is None:
            raise BadInput("nothing flies")
        folder = place.gateway_folder(self.outing.journal)
        try:
            said = await asyncio.to_thread(cut_directly, folder, drone, STOP_WITHIN)
        except NotRunning:
            raise BadInput("nobody commands the drones now") from None
        except NoAnswer:
            raise BadInput("what commands the drones does not answer") from None
        if not self.outing.lives:
            with suppress(BadInput):  # what is on record then, whoever flies it writes
                reason = f"{drone}'s motors were cut"
                lost_meanwhile(self._app, self.outing.journal, drone, reason, None)
        return said

    async def _of_the_flight(self, name: str, id: str, given: Mapping[str, object]) -> str:
        outing = self.outing
        if outing is None or not outing.lives:
            held = self.phase in (Phase.STOPPED, Phase.INTERRUPTED)
            raise BadInput("nothing flies now" + (": resume the flight first" if held else ""))
        if outing.one is None or outing.life is None:
            raise BadInput(_NOT_YET)

        def do(life: Life) -> str:
            said = perform(life.control, {"command": name, **given})
            life.control.remember(id, name)
            return said

        return await outing.one.carry_out(do)

    def leave(self) -> None:
        """Let the station end as soon as all drones are down."""
        self._leaving = True
        if self.outing is not None and self.outing.lives:
            self.outing.stops.stop(Down.LAND)
        else:
            self.leaves.set()

    def _over(self) -> None:
        """Nothing flies any more: let the plan be drawn anew, and whoever waits for it go."""
        self._lock_what_flies()
        if self.outing is not None and self.outing.records is not None:
            self.inheritance.leave(self.outing.journal, self.outing.records)
        if self._leaving:
            self.leaves.set()

    # What everybody sees

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        """Return what has changed since somebody looked, as soon as anything has, or in a second."""
        return await self._scene.newer(flight, seen, log, results)

    def console(self) -> str:
        """Return what has happened in the flight, line by line."""
        return self.outing.feed.console() if self.outing is not None else ""

    def results(self) -> list[object]:
        """Return what the flight has brought in."""
        if self.outing is None:
            return []
        return self.outing.feed.brought()


_NOT_YET = "the drones are just being asked where they are: try again in a moment"


def _heard(answer: asyncio.Future[str]) -> None:
    """Whoever asked may have gone: a refusal that nobody hears is no mistake."""
    if not answer.cancelled():
        answer.exception()
