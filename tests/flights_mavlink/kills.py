"""Kills brains and gateways of flights of vehicles that speak MAVLink, and says what came of it.

    python -m tests.flights_mavlink.kills
    python -m tests.flights_mavlink.kills --brain 45 --gateway 15 --at-once 3

Four vehicles fly, two of each make. An app that was killed is started again at once, or once all have landed, or never. It is the
vehicles' own record that says what came of it: no photo may be taken twice for a trip that was done once, each take-off ends in a
landing, and where nobody commands any more, each lands or holds as its own failsafe is set to.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field
from math import dist
from pathlib import Path
from random import Random
from tempfile import mkdtemp

from pluto_fleet.journal.reader import Reader, standing_of
from tests.apart import apart
from tests.flights_crazyflie.campaign import gateway_left
from tests.flights_mavlink.vehicles import (
    DISTANCES,
    HOMES,
    LIMIT,
    MAKES,
    MISSIONS,
    Parameters,
    never,
    package,
    prepared,
)
from tests.kill.judge import lost, phase, unkept, wrong
from tests.kill.lives import eventually
from tests.kill.trial import gateway_of, killed
from tests.kit.campaign import Campaign

BRAIN = "brain"
GATEWAY = "gateway"
BOTH = "both"
_KILLS = 4
"""How many a flight gets at most."""
_LONGEST = 9.0
"""Seconds from when a vehicle is in the air until something is killed, at most."""
_EARLY = 0.2
"""How often something is killed before, or at any rate whether one is in the air or not."""
_AT_ITS_TARGET = 2.0
"""Metres from a trip's target within which a photo is that trip's."""
_BY_ITSELF = 60.0
"""Seconds in which a vehicle whose failsafe returns or lands it must be down."""
_HOLDS = 0.3
"""Metres that one that holds may move while it is watched."""
_WATCHED = 2.0
"""Seconds for which it is watched."""
_LAST_LEG = 20.0
"""Seconds in which all have come to the ends of their legs."""

_ACTS = {"px4": {2: "returns", 3: "lands"}, "ardupilot": {1: "returns", 5: "lands"}}
"""The failsafes, by make, that bring a vehicle down which hears no ground station."""


@dataclass(slots=True)
class Tally:
    """All flights of one campaign."""

    brains: Counter[str] = field(default_factory=Counter)
    """Kills of the brain, by what went on."""
    gateways: Counter[str] = field(default_factory=Counter)
    left: Counter[str] = field(default_factory=Counter)
    """How vehicles ended that nobody commanded any more."""
    photos: int = 0
    trips: int = 0

    def lines(self) -> Iterator[str]:
        yield from killed(self.brains, self.gateways)
        yield f"{self.photos} photos of {self.trips} trips"
        left = ", ".join(f"{count} {how}" for how, count in self.left.most_common())
        yield f"left to themselves: {left or 'none'}"


@dataclass(frozen=True, slots=True)
class Case:
    """One flight, and what is killed in it."""

    seed: str
    victims: Sequence[str]

    def __str__(self) -> str:
        return f"flight {self.seed}: {', '.join(self.victims)}"


def cases(seed: int, round: int, brains: int, gateways: int) -> list[Case]:
    """Share kills out among flights; the last thing that one loses may be both."""
    random = Random(f"kills/{seed}/{round}")
    both = min(brains, gateways) // 4
    single = [BRAIN] * (brains - both) + [GATEWAY] * (gateways - both)
    random.shuffle(single)
    ends = [BOTH] * both
    shared = list[Case]()
    while single or ends:
        most = random.randint(2, _KILLS)
        last = [ends.pop()] if ends else []
        victims = [*single[: most - len(last)], *last]
        del single[: most - len(last)]
        shared.append(Case(f"{seed}/{round}/{len(shared)}", victims))
    return shared


class Trial:
    """A flight under kill -9."""

    def __init__(self, case: Case, source: Path, folder: Path, tally: Tally) -> None:
        self._random = Random(case.seed)
        self._case = case
        self._tally = tally
        self._parameters: Parameters = {
            "px4": {
                "NAV_DLL_ACT": self._random.randint(0, 3),
                "COM_DL_LOSS_T": 5,
                "COM_FAIL_ACT_T": 1,
            },
            "ardupilot": {
                "FS_GCS_ENABLE": self._random.choice((0, 1, 5)),
                "FS_GCS_TIMEOUT": 5,
                "SYSID_MYGCS": 245,
            },
        }
        self._flight = prepared(source, folder, self._parameters)
        self._seen: list[str] = []
        """What has been read of its journal."""
        self._wrong: list[str] = []

    def run(self) -> list[str]:
        """Kill, resume, and judge; return what is wrong."""
        flight = self._flight
        try:
            flight.start()
            is_abandoned = False
            for number, victim in enumerate(self._case.victims, 1):
                self._until_the_moment()
                if flight.has_ended:
                    break
                is_last = number == len(self._case.victims)
                is_abandoned = self._kill(victim, is_last)
            if is_abandoned:
                self._wrong += self._left_alone()
                self._wrong += (f"{id} fell" for id, one in flight.state.items() if one["fell"])
            else:
                self._end(flight.see_through(LIMIT))
                self._wrong += gateway_left(flight)
            self._judge()
        except AssertionError as error:
            self._wrong.append(str(error))
        finally:
            flight.end()
        return self._wrong

    def _until_the_moment(self) -> None:
        """Let it go on until something shall be killed, or it has ended."""
        flight = self._flight
        if self._random.random() >= _EARLY:
            eventually(lambda: bool(flight.airborne()) or flight.has_ended, LIMIT)
        flight.goes_on(self._random.uniform(0.0, _LONGEST))

    def _kill(self, victim: str, is_last: bool) -> bool:
        """Kill it, and have the app go on; return whether it is never started again."""
        flight = self._flight
        if victim in (GATEWAY, BOTH):
            with suppress(AssertionError, ProcessLookupError):
                flight.kill_gateway()
                self._tally.gateways[self._now()] += 1
        if victim == GATEWAY:
            return False
        if not flight.kill():
            return False
        self._tally.brains[self._now()] += 1
        goes_on = self._random.choice(("at once", "at once", "when all are down", "never"))
        if goes_on == "never" and is_last:
            return True
        if goes_on == "when all are down" and victim == BRAIN:
            flight.until(lambda: not flight.airborne())
        flight.start()
        return False

    def _left_alone(self) -> Iterator[str]:
        """Yield what is wrong with vehicles whose app was killed for good."""
        flight = self._flight
        if gateway_of(flight.journal) is not None:
            self._tally.left["landed by the gateway"] += len(flight.airborne())
            yield from gateway_left(flight)
            yield from (f"{id} is in the air" for id in flight.airborne())
            return
        left = flight.airborne()
        down = [id for id in left if (make := MAKES[id]) and self._act(make) in _ACTS[make]]
        eventually(lambda: not set(down) & set(flight.airborne()), _BY_ITSELF)
        time.sleep(_LAST_LEG)
        before = self._places()
        time.sleep(_WATCHED)
        after = self._places()
        airborne = flight.airborne()
        for id in left:
            if id in down and id in airborne:
                yield f"{id} is in the air, and its failsafe {_ACTS[MAKES[id]][self._act(MAKES[id])]}"
            elif dist(before[id], after[id]) > _HOLDS:
                yield f"{id} does not hold"
            self._tally.left["holds" if id in airborne else "has landed by itself"] += 1

    def _act(self, make: str) -> int:
        name = {"px4": "NAV_DLL_ACT", "ardupilot": "FS_GCS_ENABLE"}[make]
        return int(self._parameters[make][name])

    def _places(self) -> Mapping[str, Sequence[float]]:
        return {id: one["at"] for id, one in self._flight.state.items()}

    def _now(self) -> str:
        """Return what went on; nothing that was on record may have gone."""
        before = self._seen
        self._seen = self._rows()
        self._wrong += lost(before, self._seen)
        if not self._flight.journal.exists():
            return "setting out"
        return phase(standing_of(self._flight.journal))

    def _rows(self) -> list[str]:
        if not self._flight.journal.exists():
            return []
        with closing(Reader(self._flight.journal)) as reader:
            rows = [instant.text for instant in reader.instants()]
            if reader.damaged is not None:
                self._wrong.append(reader.damaged)
        return rows

    def _end(self, code: int) -> None:
        """Judge a flight that has come to its end."""
        flight = self._flight
        self._now()
        if code != 0:
            self._wrong.append(f"exit code {code}: {flight.lives[-1][-400:]}")
        self._wrong += unkept(flight.lives, self._seen)
        self._wrong += wrong(flight.journal, self._seen, standing_of(flight.journal))
        self._wrong += (f"{name}: {how}" for name, how in flight.ends().items() if how != _DONE)
        self._wrong += never(flight)

    def _judge(self) -> None:
        """Judge by the vehicles' record, whether it has come to its end or not."""
        flight = self._flight
        if not flight.journal.exists():
            return
        events = Counter(
            (event["event"], event["mission"], event["trip"])
            for event in flight.events
            if event["event"] in ("trip.completed", "trip.failed", "trip.interrupted")
        )
        photos = [
            (HOMES[id][0] + east, HOMES[id][1] + north)
            for id, one in flight.state.items()
            for east, north, _ in one["photos"]
        ]
        self._tally.photos += len(photos)
        for mission in MISSIONS:
            for trip, y in DISTANCES.items():
                target = (HOMES[mission][0], y)
                taken = sum(dist(photo, target) < _AT_ITS_TARGET for photo in photos)
                done = events["trip.completed", mission, trip]
                failed = events["trip.failed", mission, trip]
                failed += events["trip.interrupted", mission, trip]
                self._tally.trips += done
                if not done <= taken <= 1 + failed:
                    self._wrong.append(
                        f"{mission}/{trip}: {taken} photos; it was done {done} times, and failed {failed} times"
                    )
        for id, one in flight.state.items():
            begun = one["orders"].count(_TOOK_OFF)
            ended = one["landings"] + (id in flight.airborne())
            if begun != ended:
                self._wrong.append(f"{id} took off {begun} times, and came down {ended} times")


_DONE = "COMPLETED"
_TOOK_OFF = "22: 0"
"""A take-off that was accepted, as vehicles record it."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_mavlink.kills", __doc__)
    campaign.unit = "flight"
    campaign.option("--brain", type=int, default=45, help="kills of the brain (default: 45)")
    campaign.option("--gateway", type=int, default=15, help="of the gateway (default: 15)")
    campaign.option("--seed", type=int, default=1, help="which moments (default: 1)")
    campaign.side_by_side()
    campaign.in_time()
    options = campaign.parse(arguments)
    folder = Path(mkdtemp(prefix="kills-"))
    source = package(folder / "package")
    print(f"flights in {folder}", flush=True)
    tally = Tally()

    def flown(case: Case) -> list[str]:
        return Trial(case, source, folder / case.seed.replace("/", "-"), tally).run()

    for round in range(_ROUNDS):
        brains = max(0, options.brain - tally.brains.total())
        gateways = max(0, options.gateway - tally.gateways.total())
        if brains + gateways == 0:
            break
        for case, found in campaign.each(
            flown, cases(options.seed, round, brains, gateways), threads=True
        ):
            print(case, flush=True)
            if found:
                campaign.found(str(case), *found)
    return campaign.over(*tally.lines())


_ROUNDS = 5
"""How often flights are added, as some have ended before something was killed."""


if __name__ == "__main__":
    with apart():
        sys.exit(main())
