"""What missions and drones wait for: each wait of more than ten seconds is told once, and each landing that nobody asked for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import dist
from typing import TYPE_CHECKING, Any

from ..files.plan_check import LONG
from ..shared.domain.motion import charging
from ..shared.domain.status import DroneStatus
from ..shared.domain.text import duration, percent, place
from ..shared.fleet.reach import docked
from .mission_status import aside
from .reconcile import trip_of

if TYPE_CHECKING:
    from ..journal.standing import Record
    from ..shared.domain.model import Point
    from .recorded_flight import RecordedFlight

EVERY = 1.0
"""Seconds of a flight between two looks."""

MISSIONS_A_LOOK = 500
"""With more missions, looks are rarer."""

STILL = 0.3
"""Metres that a drone may drift which waits."""

NEAR = 1.0
"""Metres from its trip's target within which a drone acts, and does not wait."""

_UNDER_WAY = (DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)

_Key = tuple[str, str, str, object]
"""Of one wait: `mission` or `drone`, its name, for what it waits, and how often the mission has flown, or where the drone is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wait:
    """What a mission or a drone waits for."""

    what: str
    reason: str
    until: float | None = None
    """When it is over, in seconds since the app's start; None: that is not known."""


class Waits:
    """Looks at the missions and drones of a flight, and notes their waits in its journal."""

    def __init__(self, life: RecordedFlight) -> None:
        self._life = life
        self._since: dict[_Key, float] = {}
        """When each present wait has begun."""
        self._told: set[_Key] = set()
        self._places: dict[str, Point] = {}
        """Where each drone is, or has been since it came to rest."""
        self._landed: dict[str, bool] = {}

    async def watch(self) -> None:
        """Look now and then, as long as the flight lasts."""
        life = self._life
        while True:
            if life.is_set_out and not life.records.stopped:  # then all come down
                self.look()
            await life.kernel.sleep(EVERY * max(1.0, len(life.records.missions) / MISSIONS_A_LOOK))

    def look(self) -> None:
        """Note which waits are long by now, and what has landed."""
        life = self._life
        now = self._life.kernel.now
        life.driver.look()  # where the drones are
        where = life.brain.whereabouts()
        drones = life.brain.drones()
        flying = {one["drone"]: name for name, one in where.items() if one["flies"]}
        found: dict[_Key, Wait] = {}
        for name, wait in _of_missions(life.records.missions, where, life.app.resumes, now):
            found["mission", name, wait.what, life.records.missions[name]["attempts"]] = wait
        is_wanted = any(wait.what == "drone" for wait in found.values())
        for id, drone in drones.items():
            at = self._rests_at(id, drone)
            mission = flying.get(id)
            self._see_landing(id, drone, mission)
            of_drone = self._of_drone(id, {**drone, "at": at}, mission, is_wanted, now)
            if of_drone is not None:
                found["drone", id, of_drone.what, at] = of_drone
        self._since = {key: self._since.get(key, now) for key in found}
        self._told &= found.keys()
        alike: dict[Wait, list[str]] = {}
        for key, wait in found.items():
            lasts = max(now, wait.until or now) - self._since[key]
            if key in self._told or lasts < LONG:
                continue
            self._told.add(key)
            if key[0] == "drone":
                self._tell("drone.waits", wait, drone=key[1])
            else:
                alike.setdefault(wait, []).append(key[1])
        for wait, names in alike.items():
            if wait.what == "drone":
                wait = Wait(what=wait.what, reason=f"{wait.reason} ({_summary(drones, now)})")
            who = {"mission": names[0]} if len(names) == 1 else {"missions": names}
            self._tell("mission.waits", wait, **who)

    def _tell(self, event: str, wait: Wait, **who: object) -> None:
        until: dict[str, object] = {}
        if wait.until is not None:
            drift = self._life.records.clock["drift"]
            clock = round(wait.until + drift), self._life.kernel.now + drift
            until = {"until": round(wait.until, 3), "hour": self._life.hours.said(*clock)}
        self._life.note(event, **who, **{"for": wait.what, "reason": wait.reason, **until})

    # Drones

    def _rests_at(self, id: str, drone: Mapping[str, Any]) -> Point:
        """Return where a drone is; one that stands stays, though it may not know where it is."""
        known = self._places.get(id)
        stood = self._landed.get(id, False)
        stands = drone["landed"] and stood
        if known is None or (not stands and (drone["landed"] or dist(known, drone["at"]) > STILL)):
            x, y, z = drone["at"]
            self._places[id] = known = (x, y, z)
        return known

    def _of_drone(
        self, id: str, drone: Mapping[str, Any], mission: str | None, is_wanted: bool, now: float
    ) -> Wait | None:
        """Return what a drone waits for, as long as it stays where it is."""
        status = DroneStatus(drone["status"])
        is_docked = self._is_docked(id, drone)
        where = "in its dock" if is_docked else f"at {place(drone['at'])}"
        stands = f"{'stands' if drone['landed'] else 'hovers'} {where}"
        silence = self._life.link.telemetry(id).silence
        if status in _UNDER_WAY and silence > self._life.fleet.silence:
            return Wait(what="word", reason=f"is not heard: it was last {where}")
        if status is DroneStatus.RECOVERING:
            then = "to be asked how it is" if is_docked else "to be brought home"
            return Wait(what="help", reason=f"{stands} and waits {then}")
        if status is DroneStatus.BUSY and mission is None and drone["landed"]:
            return Wait(what="mission", reason=f"{stands} until its mission goes on")
        if status in _UNDER_WAY:
            if self._life.link.moves(id):  # long legs begin and end slowly
                return None
            if mission is not None and self._acts(mission, drone["at"]):
                return None
            return Wait(what="way", reason=f"{stands} and waits for its way")
        has = f"its battery has {percent(drone['battery'])}"
        if is_wanted and status is DroneStatus.CHARGING:
            if not self._life.fleet.charges_at_home:
                return Wait(what="battery", reason=f"{stands}: {has}, and nothing charges it")
            return Wait(
                what="charge", reason=f"charges: {has}", until=now + self._charges(id, drone)
            )
        if is_wanted and drone.get("aside"):
            until = drone.get("ready_at")
            return Wait(
                what="battery", reason=f"{stands}: {has}, too little for what waits", until=until
            )
        return None

    def _is_docked(self, id: str, drone: Mapping[str, Any]) -> bool:
        home = next(one.home for one in self._life.fleet.drones if one.id == id)
        x, y, z = drone["at"]
        return drone["landed"] and docked((x, y, z), home)

    def _charges(self, id: str, drone: Mapping[str, Any]) -> float:
        """Return how many seconds it takes until a drone has more than its reserve."""
        name = next(one.category for one in self._life.fleet.drones if one.id == id)
        kind = next(one for one in self._life.app.categories if one.name == name)
        return charging(
            drone["battery"], kind.reserve, kind.charge_time, self._life.fleet.motion.taper
        )

    def _acts(self, mission: str, at: Sequence[float]) -> bool:
        """Whether a drone that flies for a mission does its action, or hovers for it."""
        record = self._life.records.missions[mission]
        flight = record["flight"]
        trip = trip_of(record, flight)
        goal = None if flight is None or trip is None else flight["beside"] or trip["target"]
        return goal is not None and (flight["begun"] or dist(goal, at) < NEAR)

    def _see_landing(self, id: str, drone: Mapping[str, Any], mission: str | None) -> None:
        """Note that a drone has landed, if it was not told to, nor stands in its dock, nor is lost."""
        life = self._life
        if not drone["landed"] and life.told_to.get(id) != "land":
            life.to_land.discard(id)
        before = self._landed.get(id, True)
        self._landed[id] = drone["landed"]
        is_lost = drone["status"] == DroneStatus.LOST.value
        if before or not drone["landed"] or is_lost or self._is_docked(id, drone):
            return
        on_target = mission is not None and self._acts(mission, drone["at"])
        if id not in life.to_land and not on_target:
            life.note("drone.landed", drone=id, at=drone["at"])


def _of_missions(
    records: Mapping[str, Record],
    where: Mapping[str, Any],
    resumes: Sequence[str],
    now: float,
) -> Iterator[tuple[str, Wait]]:
    ended = {name: record["ended"] for name, record in records.items()}
    for name, record in records.items():
        if not ended[name] and (wait := of_mission(where.get(name), record, ended, resumes, now)):
            yield name, wait


def of_mission(
    where: Mapping[str, Any] | None,
    record: Record,
    ended: Mapping[str, bool],
    resumes: Sequence[str],
    now: float,
) -> Wait | None:
    """Return what a mission waits for that has not ended; None: it flies, or is about to.

    `where` is what its brain says of it, `ended` which missions have; at `resumes` it waits for drones.
    """
    if (asked := aside(record)) is not None:
        return Wait(
            what="person", reason=f"is {asked[0].value}" + (f": {asked[1]}" if asked[1] else "")
        )
    if where is None or not where["lives"] or where["flies"]:
        return None
    block = where["block"]
    promises = record["promises"]
    if (until := where["until"] or 0.0) > now:
        trip = record["todo"][0]["name"] if record["todo"] else ""
        return Wait(what="time", reason=f"waits for the time of trip {trip}", until=until)
    if not block:  # it has not begun
        first = [name for name in promises.get("after", ()) if not ended.get(name, True)]
        if first:
            return Wait(what="after", reason=f"waits for {', '.join(first)}, after which it comes")
        opens = where.get("opens", promises.get("opens")) or 0.0
        return (
            Wait(what="window", reason="waits for its window", until=opens) if opens > now else None
        )
    if where["allocated"]:
        return None
    if block in resumes and record["status"] not in ("COMPLETED", "FAILED"):
        return Wait(what="drone", reason="waits for a drone")
    return Wait(what="block", reason=f"waits for what {block} says")


_DOES = {
    "BUSY": "flying",
    "RETURNING": "coming home",
    "CHARGING": "charging",
    "RECOVERING": "recovering",
    "LOST": "lost",
    "OFFLINE": "not asked yet",
}


def _summary(drones: Mapping[str, Any], now: float) -> str:
    """Say what the drones do, for none of which a mission flies."""
    low = [one for one in drones.values() if one.get("aside")]
    retired = sum(one["retired"] for one in drones.values())
    does = Counter(one["status"] for one in drones.values() if not one["retired"])
    free = does.pop("FREE", 0) - len(low)
    said = [f"{free} free"] if free > 0 else []
    if low:
        soonest = min((one["ready_at"] for one in low if one.get("ready_at")), default=None)
        when = (
            "" if soonest is None else f", the first for {duration(max(0.0, soonest - now))} more"
        )
        said.append(f"{len(low)} too low{when}")
    said += [f"{count} {_DOES[status]}" for status, count in does.items()]
    return ", ".join([*said, *([f"{retired} retired"] if retired else [])])
