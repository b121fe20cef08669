"""The reader in a package and the library's say the same of the same mistake, and that first.

The library says more: what would be right, and every other mistake, each with its line.
"""

from __future__ import annotations

import re
import tempfile
import tomllib
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.files import fleet as full_fleet
from pluto_fleet.files import missions as full_missions
from pluto_fleet.files.toml import toml_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone.files import LARGEST
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.files.an_app import APP, OWN, PLAIN

if TYPE_CHECKING:
    from pluto_fleet.app import App

FENCED = Airspace(no_fly=(((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)),))
PLACE = re.compile(
    r"""(?:(?:mission|drone) (?:"[^"]*"|\d+)(?:, trip (?:"[^"]*"|\d+))?(?:, (?:item|parameters))?"""
    r"|\[\[?[\w.]+\]?\]|map|fleet|motion|world(?:\.\w+)?)(?:: |, (?=\w+ is not a table))"
)
"""What the mistake is in: the small reader has no lines, and calls tables in its own way."""
FURTHER = re.compile(r"[;:] |, such as |, with two brackets|, in line ")
"""Where what would be right begins, or where the other one is."""

Load = Callable[[Path], object]


def first(load: Load, path: Path) -> str:
    """Return the first sentence about a file, without its place; nothing of one that is accepted."""
    try:
        load(path)
    except BadInput as error:
        said = re.sub(rf"^{re.escape(str(path))}(:\d+)?: ", "", str(error).split("\n")[0])
        place = PLACE.match(said)
        return FURTHER.split(said[place.end() :] if place else said)[0]
    return ""


def of_fleet(path: Path, app: App = APP) -> tuple[str, str]:
    """Return what both readers say of a fleet file."""
    return (
        first(lambda path: files.load_fleet(path, app), path),
        first(lambda path: full_fleet.load_fleet(path, app), path),
    )


def of_missions(path: Path, app: App = APP) -> tuple[str, str]:
    """Return what both readers say of a missions file."""
    return (
        first(lambda path: files.load_missions(path, app, FENCED), path),
        first(lambda path: full_missions.load_missions(path, app, FENCED), path),
    )


DRONE = '[[drone]]\nid = "a"\nhome = [1, 1]\ncategory = "scout"\n'
WORLD = f'{DRONE}[[world.source]]\nquantity = "pm10"\nat = [1, 1]\n'
FLEETS = [
    ("", "has no [[drone]]"),
    ("drone = []", "has no [[drone]]"),
    ("drone = 3", "drone is not a list of tables"),
    ("drone = [3]", "drone is not a list of tables"),
    ('[drone]\nid = "a"', "drone is not a list of tables"),
    (f"map = 3\n{DRONE}", "map is not a table"),
    (f"size = 3\n{DRONE}", 'unknown key "size"'),
    (f"{DRONE}[map]\nsise = 3", 'unknown key "sise"'),
    (f"{DRONE}[map]\nsize = [20, 0]", "size […] has an element that is less than 0.1 m"),
    (f"{DRONE}[map]\nsize = [20, 1e5]", "size […] has an element that is more than 10,000 m"),
    (f"{DRONE}[map]\nsize = 20", "size 20 is not a list of 2 numbers"),
    (f'{DRONE}[map]\nsize = [20, "3 s"]', "size […] has an element that is a time, not a length"),
    (f"{DRONE}[map]\ncruise_height = 0", "cruise_height 0 is less than 0.1 m"),
    (f"{DRONE}[map]\ncruise_height = nan", "cruise_height nan is not a finite number"),
    (f"{DRONE}[map]\nceiling = 1", "cruise_height, 1.2 m, is above the ceiling, 1 m"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1, 0]]]", "no_fly area 1 is not a list of at least three corners [x, y]"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1, 0], [2, 0]]]", "no_fly area 1 covers no ground"),
    (f"{DRONE}[map]\nno_fly = [[]]", "no_fly area 1 is not a list of at least three corners [x, y]"),
    (f"{DRONE}[map]\nno_fly = 3", "no_fly 3 is not a list of areas, each a list of corners [x, y]"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [3, 0], [0, 3]]]", "home (1, 1) is inside no-fly area 1"),
    (f"{DRONE}[fleet]\nafter_trip = 'sit'", 'after_trip "sit" is none of'),
    (f"{DRONE}[fleet]\nafter_trip = [1]", "after_trip […] is none of"),
    (f"{DRONE}[fleet]\nmax_airborne = 0", "max_airborne 0 is less than 1"),
    (f"{DRONE}[fleet]\nmax_airborne = true", "max_airborne true is not a whole number"),
    (f"{DRONE}[fleet]\nmax_airborne = 2.0", "max_airborne 2.0 is not a whole number"),
    (f"{DRONE}[fleet]\nspeed = 2.0", 'unknown key "speed"'),
    ('[[drone]]\nid = "a"\nhome = [1, 1]', "has no category"),
    ('[[drone]]\nid = "a"\ncategory = "scout"', "has no home"),
    ('[[drone]]\nhome = [1, 1]\ncategory = "scout"', "has no id"),
    (DRONE.replace('"a"', '" a"'), 'id " a" begins or ends with a blank'),
    (DRONE.replace('"a"', '""'), 'id "" is empty'),
    (DRONE.replace('"a"', '"\\u001b"'), 'id "\\x1b" holds a character that cannot be shown'),
    (DRONE.replace('"a"', f'"{"x" * 201}"'), f'id "{"x" * 59}…" is longer than 200 characters'),
    (DRONE.replace('"a"', "3"), "id 3 is not a text"),
    (DRONE.replace('"scout"', '"scot"'), 'unknown category "scot"'),
    (DRONE.replace("[1, 1]", "[1]"), "home […] is not a list of 2 or 3 numbers"),
    (DRONE.replace("[1, 1]", "[1, 1, 1, 1]"), "home […] is not a list of 2 or 3 numbers"),
    (DRONE.replace("[1, 1]", "[1, true]"), "home […] has an element that is not a length"),
    (DRONE.replace("[1, 1]", "[1, 25]"), "home (1, 25) is outside the map"),
    (DRONE.replace("[1, 1]", "[1, 1, -1]"), "home (1, 1) at a height of -1 m is below the ground"),
    (f"{DRONE}speed = 3", 'unknown key "speed"'),
    (f"{DRONE}{DRONE.replace('[1, 1]', '[2, 2]')}", 'there is another drone "a"'),
    (DRONE + DRONE.replace('"a"', '"b"').replace("[1, 1]", "[1, 1.05]"), 'home is where drone "a" has its own'),
    (f"{DRONE}[world]\nbackground = {{ pm10 = true }}", "pm10 true is not a number"),
    (f"{DRONE}[world]\nbackground = 3", "background is not a table"),
    (f"{DRONE}[world]\nfeature = 3", "feature is not a list of tables"),
    (f"{DRONE}[world]\nfeature = [3]", "feature is not a list of tables"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'", "has no at"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'\nat = [1, 1]\nradius = 0", "radius 0 is less than 0.01 m"),
    (f"{WORLD}peak = 1", "has no radius"),
    (f"{WORLD}peak = inf\nradius = 1", "peak inf is not a finite number"),
    (f"{WORLD}peak = '3 m'\nradius = 1", 'peak "3 m" is not a number'),
    (f"{WORLD}peek = 1", 'unknown key "peek"'),
    (f"{DRONE}[map]\nsize = [20]", "size […] is not a list of 2 numbers"),
    (f"{DRONE}[map]\nceiling = '3 kg'", 'ceiling "3 kg" is a mass, not a length'),
    (f"{DRONE}[map]\nceiling = '3 lightyears'", 'ceiling "3 lightyears" has an unknown unit, lightyears'),
    (f"{DRONE}[map]\nceiling = 1001", "ceiling 1001 is more than 1000 m"),
    (f"{DRONE}[map]\nceiling = 1979-05-27", "ceiling 1979-05-27 is not a length"),
    (f"{DRONE}[map]\nno_fly = [3]", "no_fly area 1 is not a list of at least three corners [x, y]"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1], [2, 0]]]",
     "no_fly area 1 has a corner 2 that is not a list of 2 numbers"),
    (f"{DRONE}[map]\nno_fly = [[[0, 0], [1, 'x'], [2, 0]]]",
     "no_fly area 1 has a corner 2 that has an element that is not a length"),
    (f"fleet = 3\n{DRONE}", "fleet is not a table"),
    (f"motion = 3\n{DRONE}", "motion is not a table"),
    (f"{DRONE}[motion]\nlegs = 'round'", 'legs "round" is none of'),
    (f"{DRONE}[motion]\nlegs = 3", "legs 3 is none of"),
    (f"{DRONE}[motion]\nslack = 0.15", 'unknown key "slack"'),
    (f"{DRONE}[motion]\nlimit = 0", "limit 0 is less than 0.01 m/s"),
    (f"{DRONE}[motion]\nlimit = '3 m'", 'limit "3 m" is a length, not a speed'),
    (f"{DRONE}[motion]\ntake_off = '11 min'", 'take_off "11 min" is more than 600 s'),
    (f"{DRONE}[motion]\nsettles = '-1 s'", 'settles "-1 s" is less than 0 s'),
    (f"{DRONE}[motion]\nsettles = -1", "settles -1 is less than 0 s"),
    (f"{DRONE}[motion]\nlanding = nan", "landing nan is not a finite number"),
    (f"{DRONE}[motion]\npace = 0", "pace 0 is less than 10 %"),
    (f"{DRONE}[motion]\ndrain = '1001 %'", 'drain "1001 %" is more than 1000 %'),
    (f"{DRONE}[motion]\nspread = '31 %'", 'spread "31 %" is more than 30 %'),
    (f"{DRONE}[motion]\naction_spread = true", "action_spread true is not a percent"),
    (f"{DRONE}[motion]\ntaper = '51 %'", 'taper "51 %" is more than 50 %'),
    (f"world = [3]\n{DRONE}", "world is not a table"),
    (f"{DRONE}[fleet]\nmax_airborne = 10000000000", "max_airborne 10000000000 is too large"),
    (DRONE.replace('"scout"', "3"), "category 3 is not a text"),
    (DRONE.replace("[1, 1]", "3"), "home 3 is not a list of 2 or 3 numbers"),
    (DRONE.replace("[1, 1]", "[]"), "home [] is not a list of 2 or 3 numbers"),
    (f"{DRONE}[world]\nplants = 3", 'unknown key "plants"'),
    (f"{DRONE}[world.background]\n'two words' = 'x'", 'two words "x" is not a number'),
    (f"{DRONE}[world.background]\npm10 = 1e10", "pm10 10000000000.0 is too large"),
    (f"{DRONE}[[world.feature]]\nkind = ''\nat = [1, 1]", 'kind "" is empty'),
    (f"{DRONE}[[world.feature]]\nat = [1, 1]", "has no kind"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'\nat = [1, 1, 1]", "at […] is not a list of 2 numbers"),
    (f"{DRONE}[[world.feature]]\nkind = 'x'\nat = [1, 1]\nsize = 3", 'unknown key "size"'),
    (f"{WORLD}radius = 1", "has no peak"),
    (f"{WORLD}peak = 1\nradius = '1 s'", 'radius "1 s" is a time, not a length'),
    # of several the same one comes first
    (f"{DRONE}size = 3\n[map]\nsize = 3\nx = 1", 'unknown key "x"'),
    (f"{DRONE}size = 3\n[fleet]\nmax_airborne = 0", "max_airborne 0 is less than 1"),
    (f"{DRONE}[world]\nbackground = 3\n[[world.feature]]\n[[drone]]", "has no id"),
    (f"{DRONE}[world]\nbackground = 3\nsource = 3", "source is not a list of tables"),
    ("map = 3\nfleet = 3\ndrone = 3\nworld = 3\nx = 3", 'unknown key "x"'),
    ("map = 3\nfleet = 3\ndrone = 3\nworld = 3", "map is not a table"),
    ("fleet = 3\ndrone = 3\nworld = 3", "fleet is not a table"),
    ("drone = 3\nworld = 3", "drone is not a list of tables"),
    ('drone = [{ id = "" }, 3]', "drone is not a list of tables"),
    ("[[drone]]", "has no id"),
]  # fmt: skip

TRIP = '[[mission.trip]]\naction = "measure"\ntarget = [2, 3]\n'
POLLINATE = TRIP.replace("measure", "pollinate")
PICK = (
    '[[mission.trip]]\naction = "pick_item"\ntarget = [1, 2]\nitem = { name = "p", mass = 0.001 }\n'
)
RELEASE = PICK.replace("pick_item", "release_item")
M = '[[mission]]\nname = "north"\n'
MISSIONS = [
    ("", "has no [[mission]]"),
    ("mission = [3]", "mission is not a list of tables"),
    ("mission = 3", "mission is not a list of tables"),
    ("trips = 3", 'unknown key "trips"'),
    ("[[mission]]", "has no [[mission.trip]]"),
    (f"{M}trip = []", "has no [[mission.trip]]"),
    (f"{M}trip = [3]", "trip is not a list of tables"),
    (f"{M}speed = 3\n{TRIP}", 'unknown key "speed"'),
    (M.replace('"north"', "3") + TRIP, "name 3 is not a text"),
    (f"{M}{TRIP}{M}{TRIP}", 'there is another mission "north"'),
    (f"{M.replace('north', '2')}{TRIP}[[mission]]\n{TRIP}", 'there is another mission "2"'),
    (f"{M}safe_time = '3 m'\n{TRIP}", 'safe_time "3 m" is a length, not a time'),
    (f"{M}safe_time = -1\n{TRIP}", "safe_time -1 is less than 0"),
    (f"{M}safe_time = 0.0001\n{TRIP}", "safe_time 0.0001 is less than 0.001 s"),
    (f"{M}repeat = -1\n{TRIP}", "repeat -1 is neither a whole number from 0 on nor true"),
    (f"{M}repeat = false\n{TRIP}", "repeat false is neither a whole number from 0 on nor true"),
    (f"{M}repeat = 1.5\n{TRIP}", "repeat 1.5 is neither a whole number from 0 on nor true"),
    (f"{M}at = '25:00'\n{TRIP}", 'at "25:00" is not a time of day'),
    (f"{M}at = 8\n{TRIP}", "at 8 is not a time of day"),
    (f"{M}evaluator = 'find'\n{TRIP}", 'unknown evaluator "find"'),
    (f"{M}every = 3\n{TRIP}", 'unknown key "every"'),
    (f"{M}{TRIP}gap = 3", 'unknown key "gap"'),
    (f"{M}{TRIP}delay = '3 kg'", 'delay "3 kg" is a mass, not a time'),
    (f"{M}{TRIP}priority = 1.0", "priority 1.0 is not a whole number"),
    (f"{M}{TRIP}name = 'x '", 'name "x " begins or ends with a blank'),
    (f"{M}{TRIP}name = 'x'\n{TRIP}name = 'x'", 'there is another trip "x"'),
    (f"{M}{TRIP}name = '2'\n{TRIP}", 'there is another trip "2"'),
    (f"{M}{TRIP.replace('measure', 'mesure')}", 'unknown action "mesure"'),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 30]')}", "target (2, 30) is outside the map"),
    (f"{M}{TRIP.replace('[2, 3]', '[5, 5]')}", "target (5, 5) is inside no-fly area 1"),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 3, 11]')}", "target (2, 3) at a height of 11 m is above the ceiling of 10 m"),
    (f"{M}{TRIP.replace('[2, 3]', '[2, 3e9]')}", "target […] has an element that is too large"),
    (f"{M}{TRIP}source = [2, inf]", "source […] has an element that is not a finite number"),
    (f"{M}[[mission.trip]]\ntarget = [2, 3]", "has no action"),
    (f"{M}[[mission.trip]]\naction = 'measure'", "has no target"),
    (f"{M}{TRIP}parameters = 3", "parameters is not a table"),
    (f"{M}{TRIP}parameters = {{ dose = 3 }}", 'unknown parameter "dose"'),
    (f"{M}{POLLINATE}", "pollinate needs the parameter dose"),
    (f"{M}{POLLINATE}parameters = {{ dose = '3 m' }}", 'dose "3 m" is a length, not a mass'),
    (f"{M}{POLLINATE}parameters = {{ dose = 2e9 }}", "dose 2000000000.0 is too large"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, force = '3' }}", 'force "3" is not a number'),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, gently = 1 }}", "gently 1 is neither true nor false"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, strokes = 1.0 }}", "strokes 1.0 is not a whole number"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, note = 1 }}", "note 1 is not a text"),
    (f"{M}{TRIP}item = {{ name = 'p', mass = 1 }}", "measure takes no item"),
    (f"{M}{TRIP}item = {{}}", "measure takes no item"),
    (f"{M}{PICK.replace('item = {', '#')}", "pick_item needs an item"),
    (f"{M}{PICK.replace('0.001', '-1')}{RELEASE}", "mass -1 is less than 0 kg"),
    (f"{M}{PICK.replace(', mass = 0.001', '')}{RELEASE}", "has no mass"),
    (f"{M}{PICK.replace('0.001', '1, x = 1')}{RELEASE}", 'unknown key "x"'),
    (f"{M}{PICK}", 'picks "p", which no trip after it releases'),
    (f"{M}{RELEASE}", 'releases "p", which no trip before it has picked'),
    (f"{M}{PICK}{PICK}{RELEASE}", 'picks "p", but "p" is still aboard since trip 1'),
    (f"{M}{PICK}{RELEASE}{RELEASE}", 'releases "p", which no trip before it has picked'),
    (f"{M}{PICK}{RELEASE.replace('0.001', '0.002')}", '"p" has another mass here than in trip 1'),
    (M + PICK + RELEASE.replace('"p"', '"q"'), 'releases "q", but trip 1 picked "p"'),
    (f"{M}x = {'[' * 5000}", "is nested too deep"),
    (f"{'a.' * 200}b = 1", "is nested too deep"),
    ("x = \n", "is not valid TOML"),
    (f"{M}safe_time = {'9' * 5000}\n{TRIP}", "is not valid TOML"),
    (f"{M}safe_time = 0x{'f' * 5000}\n{TRIP}", "safe_time this number is too large"),
    (f"{M.replace('north', '')}{TRIP}", 'name "" is empty'),
    (f"{M}repeat = 10000000000\n{TRIP}", "repeat 10000000000 is too large"),
    (f"{M}repeat = 'often'\n{TRIP}", 'repeat "often" is neither a whole number from 0 on nor true'),
    (f"{M}safe_time = true\n{TRIP}", "safe_time true is not a time"),
    (f"{M}safe_time = 'soon'\n{TRIP}", 'safe_time "soon" is not a time'),
    (f"{M}safe_time = 1e300\n{TRIP}", "safe_time 1e+300 is too large"),
    (f"{M}safe_time = []\n{TRIP}", "safe_time [] is not a time"),
    (f"{M}evaluator = 3\n{TRIP}", "evaluator 3 is not a text"),
    (f"{M}evaluator = ''\n{TRIP}", 'evaluator "" is empty'),
    (M + TRIP.replace('"measure"', "3"), "action 3 is not a text"),
    (f"{M}{TRIP}source = 'home'", 'source "home" is not a list of 2 or 3 numbers'),
    (f"{M}{TRIP}source = [5, 5]", "source (5, 5) is inside no-fly area 1"),
    (f"{M}{TRIP.replace('measure', 'take_photo')}parameters = {{ zoom = 2 }}",
     'take_photo has no parameters, and "zoom" is given'),
    (f"{M}{TRIP}parameters = {{ quantity = 2 }}", "quantity 2 is not a text"),
    (f"{M}{POLLINATE}parameters = {{ dose = 0, share = '3 g' }}", 'share "3 g" is a mass, not a percent'),
    (f"{M}{TRIP}item = 3", "item is not a table"),
    (M + PICK.replace('{ name = "p", mass = 0.001 }', "[]"), "item is not a table"),
    (M + PICK.replace('"p"', '" p"'), 'name " p" begins or ends with a blank'),
    (M + PICK.replace("0.001", '"1 m"'), 'mass "1 m" is a length, not a mass'),
    (f"{M}{PICK.replace('0.001', '1001')}", "mass 1001 is more than 1000 kg"),
    # of several the same one comes first
    (f"{M}speed = 1\n{M}name = 3", "is not valid TOML"),
    (f"{M}safe_time = -1\nspeed = 1\ntrip = 3", 'unknown key "speed"'),
    (f"{M}safe_time = -1\ntrip = 3", "safe_time -1 is less than 0"),
    (f"{M}{TRIP}{M}safe_time = -1", 'there is another mission "north"'),
    (f"{M}{PICK}delay = -1\n{M}", "delay -1 is less than 0"),
    (f"{M}{PICK}{M}{RELEASE}", 'picks "p", which no trip after it releases'),
    (f"{M}[[mission.trip]]\nname = ''\nx = 1", 'unknown key "x"'),
    (f"{M}[[mission.trip]]\nname = ''\ndelay = -1", 'name "" is empty'),
    (f"{M}[[mission.trip]]\nitem = 3\ndelay = -1", "has no action"),
    (f"{M}{TRIP}delay = -1\nparameters = 3\nitem = 3", "delay -1 is less than 0"),
    (f"{M}{TRIP}parameters = 3\nitem = 3", "parameters is not a table"),
    (f"{M}{POLLINATE}parameters = {{ share = -1, x = 3 }}", 'unknown parameter "x"'),
    (f"{M}{POLLINATE}parameters = {{ force = 'x' }}", "pollinate needs the parameter dose"),
    (f"{M}{TRIP}item = {{ name = '' }}", "measure takes no item"),
    # neither reads on where this is no text, or no TOML
    ("a = 1\na = 2", "is not valid TOML"),
    ("[mission", "is not valid TOML"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "said"), FLEETS)
def test_a_fleet_that_cannot_fly_is_refused_alike(tmp_path: Path, text: str, said: str) -> None:
    """Every key, and every kind of value."""
    path = tmp_path / "fleet.toml"
    path.write_text(text, "utf-8")
    assert of_fleet(path) == (said, said)


@pytest.mark.parametrize(("text", "said"), MISSIONS)
def test_missions_that_cannot_be_flown_are_refused_alike(
    tmp_path: Path, text: str, said: str
) -> None:
    """The same for them."""
    path = tmp_path / "missions.toml"
    path.write_text(text, "utf-8")
    assert of_missions(path) == (said, said)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f'{M}evaluator = "x"\n{TRIP}', 'unknown key "evaluator"'),
        (f"{M}{TRIP}delay = 3", 'unknown key "delay"'),
        (f"{M}{TRIP}priority = 3\naction = 3", "is not valid TOML"),
    ],
)
def test_an_app_without_fields_refuses_them_alike(tmp_path: Path, text: str, said: str) -> None:
    """The library says also why there is no such key."""
    path = tmp_path / "missions.toml"
    path.write_text(text, "utf-8")
    assert of_missions(path, PLAIN) == (said, said)


def test_the_place_is_told(tmp_path: Path) -> None:
    """By the small reader, too: the file, the table in it, and in TOML that is none the line."""
    path = tmp_path / "x.toml"
    for text, where in (
        (f"{M}{TRIP}{TRIP}delay = -1", ': mission "north", trip 2: delay -1 is less'),
        (f"[[mission]]\n{PICK.replace('0.001', '-1')}", ": mission 1, trip 1, item: mass -1 is"),
        ("a = 1\nb = 1 2\n", ":2: is not valid TOML: expected newline"),
    ):
        path.write_text(text)
        with pytest.raises(BadInput, match=re.escape(f"{path}{where}")):
            files.load_missions(path, APP, FENCED)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "there is no such file"),
        (b"a = 1\nb = '\xff\xfe'", "is not UTF-8 text"),
        (b"#" * LARGEST + b"#", "is larger than 1024 KiB"),
        (b"#" * LARGEST, "has no [[mission]]"),
        (b"\xef\xbb\xbf", "has no [[mission]]"),
        (b"a = '" + b"k." * 500 + b"'", 'unknown key "a"'),
    ],
)
def test_what_is_no_plan_file_is_refused_alike(
    tmp_path: Path, content: bytes | None, said: str
) -> None:
    """Missing, not UTF-8, too large; and what only looks so."""
    path = tmp_path / "missions.toml"
    if content is not None:
        path.write_bytes(content)
    assert of_missions(path) == (said, said)
    assert of_missions(tmp_path) == ("is a folder, not a file", "is a folder, not a file")
    assert of_fleet(Path("a\0b")) == ("is not a file name", "is not a file name")


OWN_TRIP = f'{TRIP}fragile = true\nwarmth = "21 C"\n'
O = f'{M}patient = "Ada"\n'
OWN_MISSIONS = [
    (f"{O}{OWN_TRIP}", ""),
    (f"{M}{OWN_TRIP}", "has no patient"),
    (f"{O}{TRIP}warmth = 294", "has no fragile"),
    (f"{O}{TRIP}fragile = false", "has no warmth"),
    (f"{M}patients = 'Ada'\n{OWN_TRIP}", 'unknown key "patients"'),
    (f"{M}patient = 3\n{OWN_TRIP}", "patient 3 is not a text"),
    (f"{M}patient = []\n{OWN_TRIP}", "patient [] is not a text"),
    (f"{O}margin = '3 m'\n{OWN_TRIP}", 'margin "3 m" is a length, not a time'),
    (f"{O}margin = '3'\n{OWN_TRIP}", ""),
    (f"{O}margin = 'soon'\n{OWN_TRIP}", 'margin "soon" is not a time'),
    (f"{O}margin = nan\n{OWN_TRIP}", "margin nan is not a finite number"),
    (f"{O}margin = 08:00:00\n{OWN_TRIP}", "margin 08:00:00 is not a time"),
    (f"{O}share = '20 %'\nurgent = true\n{OWN_TRIP}", ""),
    (f"{O}urgent = 1\n{OWN_TRIP}", "urgent 1 is neither true nor false"),
    (f"{O}urgent = 'yes'\n{OWN_TRIP}", 'urgent "yes" is neither true nor false'),
    (f"{O}{OWN_TRIP}layers = 1.5", "layers 1.5 is not a whole number"),
    (f"{O}{OWN_TRIP}layers = {10**20}", f"layers {10**20} is too large"),
    (f"{O}{OWN_TRIP}height_over_ground = '40 kg'", 'height_over_ground "40 kg" is a mass, not a length'),
    (f"{O}{OWN_TRIP}note = {{ a = 1 }}", "note {…} is not a text"),
    (f"{O}{OWN_TRIP}delay = -1", "delay -1 is less than 0"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "said"), OWN_MISSIONS)
def test_fields_of_an_apps_own_are_read_alike(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "missions.toml"
    path.write_text(text, "utf-8")
    assert of_missions(path, OWN) == (said, said)


def test_what_must_be_filled_in_is_told_with_what_to_write(tmp_path: Path) -> None:
    """By both, and by the library with the line of the table that lacks it."""
    path = tmp_path / "missions.toml"
    path.write_text(f"{M}{TRIP}", "utf-8")
    says = 'has no patient: write patient = "text"'
    with pytest.raises(BadInput) as small:
        files.load_missions(path, OWN, FENCED)
    assert str(small.value) == f'{path}: mission "north": {says}'
    with pytest.raises(BadInput) as full:
        full_missions.load_missions(path, OWN, FENCED)
    assert str(full.value).split("\n") == [
        f'{path}:1: mission "north": {says}',
        f'{path}:3: mission "north", trip 1: has no fragile: write fragile = true',
        f'{path}:3: mission "north", trip 1: has no warmth: write warmth = "1 K"',
    ]


FLEET = """
[map]
size = [20.0, "1200 cm"]
cruise_height = 1.5
ceiling = "4 m"
no_fly = [[[8, 0], [9, 0], [9, 5], [8, 5]]]
[fleet]
after_trip = "stay"
max_airborne = 5
[motion]
legs = "straight"
limit = "0.8 m/s"
take_off = "300 ms"
pace = 1.1
spread = "2 %"
[[drone]]
id = "cf1"
category = "scout"
home = [0.5, 0.5]
[[drone]]
id = "cf2"
category = "carrier"
home = [1.5, 0.5, 0.1]
[world]
background = { pm10 = 15.0 }
feature = [{ kind = "bloom", at = [2, 3], radius = "20 cm" }, { kind = "pest", at = [3, 3] }]
source = [{ quantity = "pm10", at = [4, 4], peak = 80, radius = "3 m" }]
"""
FLOWN = f"""
[[mission]]
name = "north"
safe_time = "3 min"
repeat = 2
at = "08:30"
evaluator = "find_blooms"
{POLLINATE}
delay = "30 s"
priority = 1
parameters = {{ dose = "40 mg", share = "20 %", gently = false, note = "x" }}
{PICK}source = [0.5, 0.5]
{RELEASE}
[[mission]]
repeat = true
{TRIP}name = "B"
"""
OWN_FLOWN = f"""
[[mission]]
name = "north"
repeat = 2
patient = "Ada"
margin = "3 min"
share = 0.3
urgent = true
{OWN_TRIP}
delay = "30 s"
note = "x"
layers = 3
height_over_ground = "40 cm"
[[mission]]
patient = "Grace"
{OWN_TRIP}
"""
KEYS = [
    "patient",
    "margin",
    "fragile",
    "layers",
    "warmth",
    "id",
    "name",
    "category",
    "home",
    "kind",
    "at",
    "radius",
    "quantity",
    "peak",
    "mass",
    "item",
    "parameters",
    "dose",
    "trip",
    "mission",
    "drone",
    "map",
    "world",
    "source",
    "feature",
    "target",
    "action",
    "delay",
    "priority",
    "repeat",
    "safe_time",
    "evaluator",
    "motion",
    "legs",
    "limit",
    "settles",
    "pace",
    "taper",
    "size",
    "gap",
    "x",
]
VALUES = (
    st.sampled_from(
        ("", " a", "a\n", "cf1", "north", "p", "scout", "measure", "pick_item", "release_item",
         "3 m", "3 s", "3 g", "3", "1e3 m", "20 %", "08:00", "stay", "smooth", "1 m/s", "find_blooms", "x" * 300, "1")
    )
    | st.sampled_from((0, 1, -1, 3, 1e3, 1e12, -1e12, 10**20, 0.05, float("nan"), float("inf")))
    | st.booleans()
    | st.sampled_from(
        ([], {}, [1], [1, 1], [0.5, 0.5], [1, 1, 1], [4.5, 4.5], [1, "2 m"], [1, "2 s"], [99, 1],
         [[[0, 0], [1, 0], [0, 1]]], [[[0, 0], [1, 0], [2, 0]]], [{}], [{}, 3], {"x": 1})
    )
)  # fmt: skip


def places(data: object, place: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the paths to everything in a file."""
    inner: list[tuple[Any, Any]] = []
    if isinstance(data, dict | list):
        inner = [*(data.items() if isinstance(data, dict) else enumerate(data))]
    return [place, *(path for key, one in inner for path in places(one, (*place, key)))]


@st.composite
def mistaken(draw: st.DrawFn, text: str) -> str:
    """Return a file with up to three changes: something less, something more, or something else."""
    data = tomllib.loads(text)
    for _ in range(draw(st.integers(1, 3))):
        *way, last = draw(st.sampled_from(places(data)[1:]))
        around: Any = data
        for step in way:
            around = around[step]
        match draw(st.sampled_from(("less", "more", "else", "again"))):
            case "less":
                del around[last]
            case "more" if isinstance(around, dict):
                around[draw(st.sampled_from(KEYS))] = deepcopy(draw(VALUES))
            case "again" if isinstance(around, list):
                around.append(deepcopy(around[last]))
            case _:
                around[last] = deepcopy(draw(VALUES))
        if not data:
            break
    return toml_text(data)


@settings(max_examples=400, deadline=None)
@given(mistaken(FLEET), mistaken(FLOWN))
def test_files_with_mistakes_at_random_are_read_alike(fleet: str, missions: str) -> None:
    """Both accept them, or both refuse them with the same first sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "x.toml")
        path.write_text(fleet, "utf-8")
        small, full = of_fleet(path)
        assert small == full
        path.write_text(missions, "utf-8")
        small, full = of_missions(path)
        assert small == full


@settings(max_examples=200, deadline=None)
@given(mistaken(OWN_FLOWN))
def test_fields_with_mistakes_at_random_are_read_alike(missions: str) -> None:
    """Those of the app's own, and with them the others."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "x.toml")
        path.write_text(missions, "utf-8")
        small, full = of_missions(path, OWN)
        assert small == full


def test_the_files_without_mistakes_are_accepted(tmp_path: Path) -> None:
    """So that each change is one."""
    path = tmp_path / "x.toml"
    path.write_text(FLEET)
    assert of_fleet(path) == ("", "")
    path.write_text(FLOWN)
    assert of_missions(path) == ("", "")
    path.write_text(OWN_FLOWN)
    assert of_missions(path, OWN) == ("", "")
