"""The small reader takes what the full one takes, and refuses what that refuses for a simulation."""

from __future__ import annotations

import tempfile
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.files import missions as full_missions
from pluto_fleet.files.fleet_text import fleet_text
from pluto_fleet.trials.explore import random_missions
from pluto_fleet.trials.report import missions_text
from plutoc_runtime.alone import files
from plutoc_runtime.alone import simulate as alone
from plutoc_runtime.domain.airspace import Airspace
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from plutoc_runtime.domain.model import AfterTrip
from tests.flying import EXAMPLES
from tests.runtime.files.an_app import APP, PLAIN
from tests.runtime.files.test_fleet import FULL

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission
    from tests.flying import Example


def told(fleet: FleetData) -> object:
    """Return what the brain knows of a fleet."""
    drones = [
        tuple(getattr(drone, one.name) for one in fields(DroneData)) for drone in fleet.drones
    ]
    return fleet.airspace, drones, fleet.after_trip, fleet.max_airborne, fleet.world


def plain(missions: list[Mission[Any]]) -> str:
    """Return all that missions hold."""
    return repr(missions)


def test_the_examples_files_are_read_alike(example: Example, example_app: App) -> None:
    """Both files of each."""
    folder = EXAMPLES / example.name
    fleet = files.load_fleet(folder / "fleet.toml", example_app)
    assert told(fleet) == told(example.fleet)
    missions = files.load_missions(folder / "missions.toml", example_app, fleet.airspace)
    assert plain(missions) == plain(list(example.missions))


def test_everything_that_a_fleet_file_may_hold_is_read_alike(tmp_path: Path) -> None:
    """What only real flights need is passed over, of any type."""
    path = tmp_path / "fleet.toml"
    path.write_text(FULL)
    fleet = files.load_fleet(path, APP)
    assert told(fleet) == told(full_fleet.load_fleet(path, APP))
    path.write_text(FULL.replace('"40 cm"', "-3").replace('"lab.mocap:Mocap"', "7"))
    assert told(files.load_fleet(path, APP)) == told(fleet)


@pytest.mark.parametrize("app", [APP, PLAIN], ids=["APP", "PLAIN"])
def test_the_fleet_without_a_file_is_the_same(app: App) -> None:
    """Five drones on a plain."""
    assert told(alone.default_fleet(app)) == told(full_fleet.default_fleet(app))


places = st.floats(0.0, 19.0).map(lambda x: round(x, 3))
spots = st.tuples(places, places)
names = st.text("abcdefü -_", min_size=1, max_size=8).filter(
    lambda name: name == name.strip() != ""
)
worlds = st.builds(
    WorldData,
    features=st.lists(
        st.builds(Feature, kind=names, at=spots, radius=st.floats(0.01, 9.0)), max_size=3
    ).map(tuple),
    sources=st.lists(
        st.builds(
            Source, quantity=names, at=spots, peak=st.floats(-9, 9), radius=st.floats(0.01, 9.0)
        ),
        max_size=3,
    ).map(tuple),
    background=st.dictionaries(names, st.floats(-1e6, 1e6), max_size=2),
)


@st.composite
def fleets(draw: st.DrawFn) -> full_fleet.FleetFile:
    """Return a fleet whose drones stand apart."""
    homes = draw(
        st.lists(
            st.tuples(st.integers(0, 19), st.integers(0, 19)), min_size=1, max_size=6, unique=True
        )
    )
    return full_fleet.FleetFile(
        airspace=Airspace(
            size=(20.0, draw(st.floats(20.0, 99.0))),
            cruise_height=draw(st.floats(0.1, 3.0)),
            ceiling=draw(st.floats(3.0, 99.0)),
        ),
        drones=tuple(
            full_fleet.DroneEntry(
                id=f"{place} {draw(names)}",
                category=draw(st.sampled_from([one.name for one in APP.categories])),
                home=(float(x), float(y), draw(st.sampled_from([0.0, 0.25]))),
            )
            for place, (x, y) in enumerate(homes)
        ),
        after_trip=draw(st.sampled_from(AfterTrip)),
        max_airborne=draw(st.none() | st.integers(1, 9)),
        world=draw(worlds),
    )


@given(fleets(), st.integers(0, 10**6))
def test_plans_at_random_are_read_alike(fleet: full_fleet.FleetFile, seed: int) -> None:
    """What the full reader makes of them, the small one makes, too."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "fleet.toml")
        path.write_text(fleet_text(fleet), "utf-8")
        assert told(files.load_fleet(path, APP)) == told(full_fleet.load_fleet(path, APP))
        drawn = random_missions(APP, fleet, seed)
        if drawn:
            path.write_text(missions_text(APP, drawn), "utf-8")
            both = (files.load_missions, full_missions.load_missions)
            small, full = (plain(load(path, APP, fleet.airspace)) for load in both)
            assert small == full


DRONE = '[[drone]]\nid = "a"\nhome = [1, 1]\ncategory = "scout"\n'
WORLD = f'{DRONE}[[world.source]]\nquantity = "pm10"\nat = [1, 1]\n'
FLEETS = [
    ("", "has no drone"),
    ("drone = []", "drone []"),
    ("drone = 3", "drone 3"),
    ("drone = [3]", "drone 1: is not a table"),
    ('[drone]\nid = "a"', "drone {"),
    (f"map = 3\n{DRONE}", "map 3 is not a table"),
    (f"size = 3\n{DRONE}", 'unknown key "size"'),
    (f"{DRONE}[map]\nsise = 3", 'map: unknown key "sise"'),
    (f"{DRONE}[map]\nsize = [20, 0]", "map: size [20, 0]"),
    (f"{DRONE}[map]\nsize = [20, 1e5]", "map: size"),
    (f"{DRONE}[map]\nsize = 20", "map: size 20"),
    (f'{DRONE}[map]\nsize = [20, "3 s"]', "map: size"),
    (f"{DRONE}[map]\ncruise_height = 0", "map: cruise_height 0"),
    (f"{DRONE}[map]\ncruise_height = nan", "map: cruise_height nan"),
    (f"{DRONE}[map]\nceiling = 1", "map: cruise_height is above the ceiling, 1 m"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1, 0]]]", "map: no_fly"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1, 0], [2, 0]]]", "map: no_fly"),
    (f"{DRONE}[map]\nno_fly = [[]]", "map: no_fly"),
    (f"{DRONE}[map]\nno_fly = 3", "map: no_fly 3"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [3, 0], [0, 3]]]", "drone 1: home [1, 1]"),
    (f"{DRONE}[fleet]\nafter_trip = 'sit'", "fleet: after_trip 'sit'"),
    (f"{DRONE}[fleet]\nafter_trip = [1]", "fleet: after_trip [1]"),
    (f"{DRONE}[fleet]\nmax_airborne = 0", "fleet: max_airborne 0"),
    (f"{DRONE}[fleet]\nmax_airborne = true", "fleet: max_airborne True"),
    (f"{DRONE}[fleet]\nmax_airborne = 2.0", "fleet: max_airborne 2.0"),
    (f"{DRONE}[fleet]\nspeed = 2.0", 'fleet: unknown key "speed"'),
    ('[[drone]]\nid = "a"\nhome = [1, 1]', "drone 1: has no category"),
    ('[[drone]]\nid = "a"\ncategory = "scout"', "drone 1: has no home"),
    ('[[drone]]\nhome = [1, 1]\ncategory = "scout"', "drone 1: has no id"),
    (DRONE.replace('"a"', '" a"'), "drone 1: id ' a'"),
    (DRONE.replace('"a"', '""'), "drone 1: id ''"),
    (DRONE.replace('"a"', '"\\u001b"'), "drone 1: id"),
    (DRONE.replace('"a"', f'"{"x" * 201}"'), "drone 1: id"),
    (DRONE.replace('"a"', "3"), "drone 1: id 3"),
    (DRONE.replace('"scout"', '"scot"'), "drone 1: category 'scot'"),
    (DRONE.replace("[1, 1]", "[1]"), "drone 1: home [1]"),
    (DRONE.replace("[1, 1]", "[1, 1, 1, 1]"), "drone 1: home"),
    (DRONE.replace("[1, 1]", "[1, true]"), "drone 1: home [1, True]"),
    (DRONE.replace("[1, 1]", "[1, 25]"), "drone 1: home [1, 25]"),
    (DRONE.replace("[1, 1]", "[1, 1, -1]"), "drone 1: home [1, 1, -1]"),
    (f"{DRONE}speed = 3", 'drone 1: unknown key "speed"'),
    (f"{DRONE}{DRONE.replace('[1, 1]', '[2, 2]')}", 'drone "a": there are 2'),
    (DRONE + DRONE.replace('"a"', '"b"').replace("[1, 1]", "[1, 1.05]"), "drone 2: home is where"),
    (f"{DRONE}[world]\nbackground = {{ pm10 = true }}", "world: background"),
    (f"{DRONE}[world]\nbackground = 3", "world: background 3"),
    (f"{DRONE}[world]\nfeature = 3", "world: feature 3"),
    (f"{DRONE}[world]\nfeature = [3]", "world.feature: is not a table"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'", "world.feature: has no at"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'\nat = [1, 1]\nradius = 0", "world.feature: radius 0"),
    (f"{WORLD}peak = 1", "world.source: has no radius"),
    (f"{WORLD}peak = inf\nradius = 1", "world.source: peak inf"),
    (f"{WORLD}peak = '3 m'\nradius = 1", "world.source: peak '3 m'"),
    (f"{WORLD}peek = 1", 'world.source: unknown key "peek"'),
]  # fmt: skip

TRIP = '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'
POLLINATE = TRIP.replace("measure", "pollinate")
PICK = (
    '[[mission.trip]]\naction = "pick_item"\ntarget = [1, 2]\nitem = { name = "p", mass = 0.001 }\n'
)
RELEASE = PICK.replace("pick_item", "release_item")
M = '[[mission]]\nname = "north"\n'
MISSIONS = [
    ("", "has no mission"),
    ("mission = [3]", "mission 1: is not a table"),
    ("mission = 3", "mission 3"),
    ("trips = 3", 'unknown key "trips"'),
    ("[[mission]]", 'mission 1: has no trip'),
    (f"{M}trip = []", 'mission "north": trip []'),
    (f"{M}trip = [3]", 'mission "north", trip 1: is not a table'),
    (f"{M}speed = 3\n{TRIP}", 'mission "north": unknown key "speed"'),
    (M.replace('"north"', "3") + TRIP, "mission 1: name 3"),
    (f"{M}{TRIP}{M}{TRIP}", 'mission "north": there are 2'),
    (f"{M.replace('north', '2')}{TRIP}[[mission]]\n{TRIP}", 'mission "2": there are 2'),
    (f"{M}safe_time = '3 m'\n{TRIP}", """mission "north": safe_time '3 m'"""),
    (f"{M}safe_time = -1\n{TRIP}", 'mission "north": safe_time -1'),
    (f"{M}safe_time = 0.0001\n{TRIP}", 'mission "north": safe_time 0.0001'),
    (f"{M}repeat = -1\n{TRIP}", 'mission "north": repeat -1'),
    (f"{M}repeat = false\n{TRIP}", 'mission "north": repeat False'),
    (f"{M}repeat = 1.5\n{TRIP}", 'mission "north": repeat 1.5'),
    (f"{M}at = '25:00'\n{TRIP}", """mission "north": at '25:00'"""),
    (f"{M}at = 8\n{TRIP}", 'mission "north": at 8'),
    (f"{M}evaluator = 'find'\n{TRIP}", """mission "north": evaluator 'find'"""),
    (f"{M}every = 3\n{TRIP}", 'mission "north": unknown key "every"'),
    (f"{M}{TRIP}gap = 3", 'mission "north", trip 1: unknown key "gap"'),
    (f"{M}{TRIP}delay = '3 kg'", """mission "north", trip 1: delay '3 kg'"""),
    (f"{M}{TRIP}priority = 1.0", 'mission "north", trip 1: priority 1.0'),
    (f"{M}{TRIP}name = 'x '", """mission "north", trip 1: name 'x '"""),
    (f"{M}{TRIP}name = 'x'\n{TRIP}name = 'x'", 'mission "north", trip "x": there are 2'),
    (f"{M}{TRIP}name = '2'\n{TRIP}", 'mission "north", trip "2": there are 2'),
    (f"{M}{TRIP.replace('measure', 'mesure')}", """mission "north", trip 1: action 'mesure'"""),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 30]')}", 'mission "north", trip 1: target [2, 30]'),
    (f"{M}{TRIP.replace('[2, 3]', '[5, 5]')}", 'mission "north", trip 1: target [5, 5]'),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 3, 11]')}", 'mission "north", trip 1: target [2, 3, 11]'),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 3e9]')}", 'mission "north", trip 1: target'),
    (f"{M}{TRIP}source = [2, inf]", 'mission "north", trip 1: source [2, inf]'),
    (f"{M}[[mission.trip]]\ntarget = [2, 3]", 'mission "north", trip 1: has no action'),
    (f"{M}[[mission.trip]]\naction = 'measure'", 'mission "north", trip 1: has no target'),
    (f"{M}{TRIP}parameters = 3", 'mission "north", trip 1: parameters 3'),
    (f"{M}{TRIP}parameters = {{ dose = 3 }}", 'trip 1, parameters: unknown key "dose"'),
    (f"{M}{POLLINATE}", "trip 1, parameters: has no dose"),
    (f"{M}{POLLINATE}parameters = {{ dose = '3 m' }}", "trip 1, parameters: dose '3 m'"),
    (f"{M}{POLLINATE}parameters = {{ dose = 2e9 }}", "trip 1, parameters: dose 2000000000.0"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, force = '3' }}", "trip 1, parameters: force '3'"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, gently = 1 }}", "trip 1, parameters: gently 1"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, strokes = 1.0 }}", "trip 1, parameters: strokes 1.0"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, note = 1 }}", "trip 1, parameters: note 1"),
    (f"{M}{TRIP}item = {{ name = 'p', mass = 1 }}", "trip 1: measure takes no item"),
    (f"{M}{TRIP}item = {{}}", "trip 1: measure takes no item"),
    (f"{M}{PICK.replace('item = {', '#')}", "trip 1: pick_item needs an item"),
    (f"{M}{PICK.replace('0.001', '-1')}{RELEASE}", "trip 1, item: mass -1"),
    (f"{M}{PICK.replace(', mass = 0.001', '')}{RELEASE}", "trip 1, item: has no mass"),
    (f"{M}{PICK.replace('0.001', '1, x = 1')}{RELEASE}", 'trip 1, item: unknown key "x"'),
    (f"{M}{PICK}", "trip 1: \"p\" is still aboard"),
    (f"{M}{RELEASE}", "trip 1: releases an item that was not picked"),
    (f"{M}{PICK}{PICK}{RELEASE}", "trip 2: picks an item while"),
    (f"{M}{PICK}{RELEASE}{RELEASE}", "trip 3: releases an item"),
    (f"{M}{PICK}{RELEASE.replace('0.001', '0.002')}", "trip 2: releases an item"),
    (M + PICK + RELEASE.replace('"p"', '"q"'), "trip 2: releases an item"),
    (f"{M}x = {'[' * 5000}", "is no plan file"),
    (f"{'a.' * 200}b = 1", "nested too deep"),
    ("x = \n", "is no plan file"),
    (f"{M}safe_time = {'9' * 5000}\n{TRIP}", "is no plan file"),
    (f"{M}safe_time = 0x{'f' * 5000}\n{TRIP}", 'mission "north": safe_time <int'),
]  # fmt: skip
FENCED = Airspace(no_fly=(((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)),))


@pytest.mark.parametrize(("text", "said"), FLEETS)
def test_a_fleet_that_cannot_fly_is_refused(tmp_path: Path, text: str, said: str) -> None:
    """The message names the file, the place in it and the value; the full reader refuses it, too."""
    path = tmp_path / "fleet.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(BadInput):
        full_fleet.load_fleet(path, APP)
    with pytest.raises(BadInput) as refused:
        files.load_fleet(path, APP)
    assert str(refused.value).startswith(f"{path}: ")
    assert said in str(refused.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize(("text", "said"), MISSIONS)
def test_missions_that_cannot_be_flown_are_refused(tmp_path: Path, text: str, said: str) -> None:
    """The same for them."""
    path = tmp_path / "missions.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(BadInput):
        full_missions.load_missions(path, APP, FENCED)
    with pytest.raises(BadInput) as refused:
        files.load_missions(path, APP, FENCED)
    assert str(refused.value).startswith(f"{path}: ")
    assert said in str(refused.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "cannot be read: No such file"),
        (b"\xff\xfe", "is no plan file"),
        (b"#" * (1 << 20) + b"#", "larger than 1 MiB"),
    ],
)
def test_what_is_no_plan_file_is_refused(tmp_path: Path, content: bytes | None, said: str) -> None:
    """Missing, not UTF-8, too large."""
    path = tmp_path / "missions.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(BadInput, match=said):
        files.load_missions(path, APP, FENCED)
    with pytest.raises(BadInput, match="cannot be read"):
        files.load_missions(tmp_path, APP, FENCED)
