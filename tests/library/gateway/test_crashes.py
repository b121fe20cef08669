"""Any sequence of crashes, mishaps and Stops: nothing is done twice, or told in two ways."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.gateway.gateway import Gateway, Link
from pluto_fleet.gateway.ledger import FileLedger
from pluto_fleet.gateway.lossy_line import LOST, LossyLine
from pluto_fleet.jobs.reports import Down, JobState
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.virtual import VirtualTime
from pluto_fleet.simulation.drones import WorldAction
from pluto_fleet.simulation.radio import Radio
from tests.library.gateway.flights import Field, Task
from tests.library.simulation.flights import fly

EVENTS = (
    "wait",
    "brain",
    "gateway",
    "reboot",
    "link",
    "crash",
    "battery",
    "line",
    "land",
    "rtl",
    "cut",
    "mended",
)
DRONES = 3


class World(Field):
    """A field that is struck, and brains that do as brains do, one after the other."""

    def __init__(self, folder: Path | None, slow: float) -> None:
        self.slow = slow
        self.folder = folder
        super().__init__(ledger=None if folder is None else FileLedger(folder / "ledger"))
        self.deeds: list[WorldAction] = []
        self.navigation.record = self.deeds.append
        self.jobs = [
            Task(id=f"{n}", drone=f"cf{n + 1}", stops=((2.0 + n, 3.0, 1.2),)) for n in range(DRONES)
        ]
        self.reported: dict[str, object] = {}
        self.unknown: set[str] = set()
        self.epoch = 0
        self.line_breaks = False
        self.cut_after: float | None = None
        """How far cf1 had flown when its motors were cut; it was not looked after since."""

    def another(self) -> Gateway:
        """Begin another gateway, over a radio that may be slow and a line that may break."""
        radio = Radio(self.kernel, self.navigation, lambda _: self.slow)
        self.gateway = Gateway(
            self.kernel, radio, self.drones, self.airspace, ledger=self.ledger, patience=3
        )
        self.gateway.line = LossyLine(self.gateway, self.delay)
        return self.gateway

    def delay(self) -> float:
        """Say what becomes of a report: the next one may break the line."""
        breaks, self.line_breaks = self.line_breaks, False
        return LOST if breaks else 0.0

    def strike(self, what: str) -> None:
        """Let something happen."""
        match what:
            case "gateway":
                self.gateway.crash()
                if isinstance(self.ledger, FileLedger) and self.folder is not None:
                    self.ledger.close()
                    self.ledger = FileLedger(self.folder / "ledger")
                self.another()
            case "reboot":
                self.navigation.reboot("cf1")
                if self.cut_after is not None:  # it was put into its dock, and does not say so
                    self.navigation.mended("cf1")
            case "link":
                self.navigation.strike("cf1", Failure.LINK)
            case "crash":
                self.navigation.strike("cf2", Failure.CRASH)
            case "battery":
                self.navigation.strike("cf3", Failure.BATTERY)
            case "line":
                self.line_breaks = True
            case "land":
                self.gateway.fail_safe(Down.LAND)
            case "rtl":
                self.gateway.fail_safe(Down.HOME)
            case "cut":
                if fly(self.virtual, self.gateway.cut_motors("cf1")) == "":
                    self.cut_after = self.navigation.flown("cf1")
            case "mended":
                self.gateway.navigation.mended("cf1")
                self.cut_after = None

    def live(self, seconds: int) -> None:
        """Let a brain link, do what it finds to do, and live for a while."""
        self.epoch += 1
        kernel, lost = self.kernel, list[None]()
        assert isinstance(kernel, VirtualTime)
        link = self.gateway.link(self.epoch, partial(lost.append, None))
        errands = kernel.spawn(self.do(link), FLEET, f"brain {self.epoch}")
        for _ in range(seconds):
            link.heartbeat()
            self.advance(1)
        errands.cancel()

    async def do(self, link: Link) -> None:
        """Query all drones; attach to what flies or is done, fly what was not; ask no other."""
        fleet_report = await link.fleet_report()
        for job in self.jobs:
            known = fleet_report.jobs.get(job.id)
            state = None if known is None else known.state
            if job.id in self.reported:
                assert state is JobState.DONE
            elif known is not None and (known.flies or state is JobState.DONE):
                link.attach(job.id, partial(self.heard, job))
            elif state is JobState.BEGUN:
                self.unknown.add(job.id)
            else:
                if not fleet_report.drones[job.drone].reached and not await link.recover(job.drone):
                    continue
                link.fly(job, partial(self.heard, job))

    def heard(self, job: Task, result: object) -> None:
        """Hear how a job ended."""
        if not isinstance(result, FlightFailed):
            self.reported[job.id] = result


@settings(max_examples=20)
@given(
    st.lists(st.tuples(st.sampled_from(EVENTS), st.integers(0, 9)), max_size=10),
    st.booleans(),
    st.sampled_from([0.0, 0.5, 2.0]),
)
def test_no_sequence_of_crashes_does_anything_twice(
    crashes: list[tuple[str, int]], in_a_file: bool, slow: float
) -> None:
    """What is not known is left to a person, who is not asked here: it is not flown again.

    Nor is a drone whose motors were cut, before a person has looked after it.
    """
    with TemporaryDirectory() as folder:
        world = World(Path(folder) if in_a_file else None, slow)
        for what, seconds in crashes:
            world.live(seconds)
            world.strike(what)
        world.advance(100)
        for _ in range(2):
            world.live(400)
        done = [deed.job for deed in world.deeds]
        assert len(done) == len(set(done))
        assert world.reported.keys() <= set(done)
        for job in world.jobs:
            report = fly(world.virtual, world.navigation.drone_report(job.drone))
            cut = job.drone == "cf1" and world.cut_after is not None
            out = cut or not report.reached
            assert job.id in world.reported or job.id in world.unknown or out
        assert world.cut_after in (None, world.navigation.flown("cf1"))
        world.kernel.close()
        if isinstance(world.ledger, FileLedger):
            world.ledger.close()
