"""At which blocks missions are, read off where their coroutines wait."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy

import pytest

from pluto_fleet.flight.simulation import Simulation
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.time.virtual import VirtualTime
from pluto_fleet.station.rows import blocks_of
from plutoc.compile import analyse
from plutoc.source import Source
from tests.kit.apps import EXAMPLES, example

DECLARATIONS = {
    "wait = Clock": ("wait",),
    "allocate = DroneAllocator(policy: nearest)": ("allocate",),
    "say = MissionModifier(hook: tell, to: [1, 2])": ("say",),
    "launch -> [watch, timer] -> first = GateFIFO": ("watch", "timer"),
    "launch -> [watch, limit -> other] -> all = GateFunnel": ("watch", "limit"),
    "": (),
}


@pytest.mark.parametrize("declaration", DECLARATIONS)
def test_a_declaration_above_a_call_names_its_blocks(declaration: str) -> None:
    assert blocks_of(declaration) == DECLARATIONS[declaration]


def blocks_met(name: str) -> Mapping[str, Sequence[tuple[str, ...]]]:
    """Fly an example, and return at which blocks each mission was after each event, in order."""
    flown = example(name)
    missions = deepcopy(flown.missions)
    met: dict[str, list[tuple[str, ...]]] = {m.name: [] for m in missions}

    def look() -> None:
        for mission, where in simulation.brain.whereabouts().items():
            at, known = blocks_of(where["block"]), met[mission]
            if at and (not known or known[-1] != at):
                known.append(at)

    kernel = VirtualTime()
    simulation = Simulation(flown.app, flown.fleet, kernel, 0, Faults(), lambda event: None)
    kernel.settled = look
    kernel.run(simulation.start(missions), 100_000.0)
    simulation.close()
    return met


@pytest.mark.parametrize("name", sorted(path.name for path in EXAMPLES.iterdir()))
def test_a_mission_is_only_ever_at_blocks_of_its_graph(name: str) -> None:
    source = Source("app.pluto", (EXAMPLES / name / "app.pluto").read_text())
    blocks = {node.name for node in analyse(source)[0].graph.nodes}
    met = blocks_met(name)
    for seen in met.values():
        assert seen
        assert {block for at in seen for block in at} <= blocks


def test_a_mission_of_alfalfa_is_seen_to_wait_and_in_the_fork_in_which_it_flies() -> None:
    met = {at for seen in blocks_met("alfalfa").values() for at in seen}
    assert {("wait",), ("watch", "timer")} <= met
