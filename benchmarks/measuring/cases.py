"""Which contenders fly what."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from contenders.work import Work

from .rounds import PATIENCE, Case


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """How much is flown."""

    work: Work
    """Contended: ten missions for each drone."""
    repeat: int
    """How often a light contender flies it in one process."""
    many: int
    """Missions in flight at once, and a tenth of them to compare with."""
    flight: float
    """Seconds, where flights take time."""
    turns: int
    """Trips of the one mission that flies them."""
    crowd: Work
    """Missions, most of which wait, where flights take time."""
    patience: float
    """Seconds after which a case is given up."""


FULL = Size(
    work=Work(),
    repeat=5,
    many=100_000,
    flight=0.05,
    turns=60,
    crowd=Work(missions=75, trips=4, drones=15),
    patience=PATIENCE,
)
SMALL = Size(
    work=Work(missions=20, trips=2, drones=2),
    repeat=1,
    many=200,
    flight=0.001,
    turns=3,
    crowd=Work(missions=6, trips=2, drones=2),
    patience=60.0,
)
"""Enough to see that everything works; its figures mean nothing."""

FRAMEWORKS = {
    "simpy": ("simpy_processes", "simpy"),
    "py_trees": ("behaviour_trees", "py_trees"),
    "transitions": ("transitions_machine", "transitions"),
    "python_statemachine": ("statemachine_charts", "statemachine"),
    "langgraph": ("langgraph_graph", "langgraph"),
    "thesis": ("thesis_threads", "threading"),
}
"""The heavy ones: the module, and what must be installed for it. They fly once a round."""


def cases(size: Size, package: str, plain: str) -> Iterator[Case]:
    """Give all cases; the packages are our own, compiled as usual and with -O0."""
    contended, free = size.work, replace(size.work, drones=size.work.missions)
    ours = ("--package", package)
    for name, work in (("contended", contended), ("free", free)):
        light = (*arguments(work), "--repeat", str(size.repeat))
        yield Case(name=f"ideal_{name}", module="ideal", arguments=light)
        yield Case(name=f"ours_{name}", module="ours", arguments=(*ours, *light))
        yield Case(name=f"direct_{name}", module="direct", arguments=light)
        yield Case(name=f"generators_{name}", module="generators", arguments=light)
        virtual = (*ours, "--virtual", *light)
        yield Case(name=f"ours_virtual_{name}", module="ours", arguments=virtual)
    light = (*arguments(contended), "--repeat", str(size.repeat))
    yield Case(name="ours_journal", module="ours", arguments=(*ours, "--journal", *light))
    yield Case(name="ours_plain", module="ours", arguments=("--package", plain, *light))
    for name, (module, needs) in FRAMEWORKS.items():
        yield Case(name=name, module=module, needs=needs, arguments=arguments(contended))
    for name, many in (("ours_many", size.many), ("ours_a_tenth", size.many // 10)):
        work = Work(missions=many, drones=many)
        together = (*ours, "--together", *arguments(work))
        yield Case(name=name, module="ours", arguments=together, rounds=3)
    alone = Work(missions=1, trips=size.turns, drones=1)
    for name, work in (("alone", alone), ("crowd", size.crowd)):
        timed = (*arguments(work), "--flight", str(size.flight))
        yield Case(name=f"ours_{name}", module="ours", arguments=(*ours, *timed))
        yield Case(name=f"ideal_{name}", module="ideal", arguments=timed)


def arguments(work: Work) -> tuple[str, ...]:
    """Return what a contender is told of its work."""
    sizes = {"--missions": work.missions, "--trips": work.trips, "--drones": work.drones}
    return tuple(text for name, value in sizes.items() for text in (name, str(value)))
