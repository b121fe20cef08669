"""Apps as most people write them, grown by chance along the grammar.

Those of `grown` try every part of the grammar, and odd names, and some are spoilt: most are near enough to a legal
one to get far. Those of `calm` are legal, and their hooks and limits are such that all their missions come to an end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random
from typing import ClassVar

from tests.fuzz.texts import HOSTILE, legal
from tests.mutations import mutated

VERSIONS = ("1.2.0", "0.1.0", "2!1.0rc1+here", "1.2.0-beta", "1.x", "", "1" * 5000)
REQUIREMENTS = (
    *("numpy>=2", "NumPy", "requests[socks]>=2.32,<3", "a_b; python_version < '3.13'"),
    *("tools @ https://example.org/tools.whl", "numpy=>2", "pluto-fleet", "grown", "a, b", "", "("),
)
NAMES = (
    *("version", "requires"),
    *("watch", "first", "retry", "a", "b1", "list", "print", "status", "run", "mission", "hooks"),
    *("dict", "float", "int", "str", "builtins", "partial", "at", "trip", "flow", "app_2", "odd_"),
    *("x" * 63, "type_", "object", "annotations", "model", "results", "func", "none", "true"),
    *("Watch", "when", "class", "end", "self", "é", "_a", "match", "x" * 64, "a__b", "True"),
)
GOOD_NAMES = NAMES[:28]
FIELD_NAMES = (
    *("patient", "margin", "note", "float", "str", "builtins", "dataclass", "model", "has"),
    *("type_", "delay", "priority", "status", "name", "trip", "mission", "Note", "class", "x"),
    *("é", "deadline"),
)
RESULTS = ("", "", " -> float", " -> photo", " -> mass", " -> text", " -> bool", " -> nothing")
TYPES = (
    *("int", "float", "bool", "text", "mass", "length", "time", "angle", "percent", "speed"),
    "temperature",
)
GOOD_VALUES = {
    "int": ("0", "-7", "123456789012345"),
    "float": ("1.5", "-0.0", "999999999999999", "0.00000000000001"),
    "bool": ("yes", "no"),
    "mass": ("5 g", "50 mg", "1.25kg"),
    "length": ("2.5 m", "3 km"),
    "time": ("5 min", "0 s", "2 h"),
    "angle": ("90 deg", "-1 rad"),
    "percent": ("40 %", "0%", "100 %"),
    "speed": ("2 m/s", "3.6 km/h"),
    "temperature": ("20 C", "-273.15 C", "300 K"),
}
BAD_VALUES = ("5 parsec", "-1 s", "[1, [2]]", "nearest", '"x"', "9" * 16, "1 m/h", "[]", "when")
SPOILS = (
    "delete a token",
    "duplicate a token",
    "swap two tokens",
    "insert a token",
    "duplicate a line",
)


@dataclass(kw_only=True)
class Growth:
    """An app on the way: its statements, and what they can name."""

    policies: ClassVar[Sequence[str]] = (
        "nearest",
        "first",
        "least_used",
        "batch_optimal",
        "own",
        "own",
    )
    bounds: ClassVar[Sequence[str]] = ("", "max_attempts: 0", "max_attempts: 1", "max_attempts: 5")
    gates: ClassVar[Sequence[str]] = ("GateFIFO", "GateFIFO", "GateFunnel")
    random: Random
    declared: list[str] = field(default_factory=list)
    blocks: list[str] = field(default_factory=list)
    flows: list[str] = field(default_factory=list)
    taken: set[str] = field(default_factory=set)

    def chance(self, share: float) -> bool:
        """Say yes so often."""
        return self.random.random() < share

    def name(self, plain: str) -> str:
        """Return a name that is free: nearly always a good one."""
        names = NAMES if self.chance(0.1) else GOOD_NAMES
        odd = self.random.choice(names) if self.chance(0.1) else plain
        name = odd if odd not in self.taken else plain
        while name in self.taken:
            name += "_2"
        self.taken.add(name)
        return name

    def value(self, kind: str) -> str:
        """Return a value of a type, nearly always."""
        if self.chance(0.02):
            return self.random.choice(BAD_VALUES)
        return text(self.random) if kind == "text" else self.random.choice(GOOD_VALUES[kind])

    def block(self, plain: str, kind: str, *values: str) -> str:
        """Declare a block and return its name."""
        name = self.name(plain)
        given = f"({', '.join(values)})" if values else ""
        self.blocks.append(f"{name} = {kind}{given}")
        return name

    def parameters(self) -> tuple[str, list[tuple[str, str]]]:
        """Return declared parameters as written, and those that must be given, with their types."""
        written, needed = [], []
        for i in range(self.random.choice((0, 0, 1, 2, 5))):
            name = self.random.choice((f"p{i}", f"p{i}", *GOOD_NAMES)) + f"_{i}" * (i > 0)
            kind = self.random.choice(TYPES)
            if self.chance(0.6):
                written.append(f"{name}: {kind} = {self.value(kind)}")
            else:
                written.append(f"{name}: {kind}")
                needed.append((name, kind))
        return (f"({', '.join(written)})" if written else ""), needed

    def limit(self) -> str:
        """Return the time of a monitor as it is given, if it is."""
        return f"default: {self.value('time')}" if self.chance(0.5) else ""

    def beside(self) -> list[str]:
        """Return what stands beside the block that watches a flight."""
        kinds = ("TimerMonitor", "GapMonitor", "TripMonitor", "modifier")
        return self.random.choices(kinds, k=self.random.choice((0, 1, 1, 2, 8)))

    def before(self) -> list[str]:
        """Declare what a mission comes to before it is given a drone."""
        return [
            _modifier(self, "STANDBY", "UNEXECUTED") for _ in range(self.random.choice((0, 0, 1)))
        ]

    def text(self, title: str = "drawn") -> str:
        """Return the source."""
        return "\n".join(
            ["pluto 1", f"app {title} {{", *self.declared, *self.blocks, *self.flows, "}", ""]
        )


class Calm(Growth):
    """One that is well, and whose missions end."""

    policies = Growth.policies[:4]
    bounds = ("max_attempts: 2", "max_attempts: 3", "max_attempts: 5")
    gates = ("GateFIFO",)

    def name(self, plain: str) -> str:
        """Return the name as it is: hooks are found by it."""
        return plain

    def parameters(self) -> tuple[str, list[tuple[str, str]]]:
        """Declare none."""
        return "", []

    def limit(self) -> str:
        """Return one that some flights keep."""
        return f"default: {self.random.choice(('30 s', '2 min', '8 min'))}"

    def beside(self) -> list[str]:
        """Return what limits a flight."""
        return [kind for kind in ("TimerMonitor", "GapMonitor") if self.chance(0.35)]

    def before(self) -> list[str]:
        """Declare nothing."""
        return []


def calm(random: Random, *declared: str) -> str:
    """Return an app that declares this."""
    app = Calm(random=random, declared=list(declared))
    _graph(app)
    return app.text()


def text(random: Random) -> str:
    """Return a text in quotes."""
    said = "".join(random.choices(HOSTILE, k=random.choice((1, 1, 2, 5))))
    return f'"{said if random.random() < 0.05 else legal(said)}"'


def grown(random: Random) -> str:
    """Return an app."""
    app = Growth(random=random)
    if app.chance(0.2):
        _settings(app)
    if app.chance(0.5):
        _categories(app)
    if app.chance(0.4):
        _fields(app)
    _graph(app)
    if app.chance(0.2):
        _events(app)
    parts = [app.declared, app.blocks, app.flows]
    if app.chance(0.2):
        parts.reverse()
    statements = [statement for part in parts for statement in part]
    for _ in range(random.choice((0, 0, 0, 0, 1, 1, 2, 4))):
        at = random.randrange(len(statements))
        statements[at] = mutated(statements[at], random.choice(SPOILS), random)
    title = f" {text(random)}" if app.chance(0.5) else ""
    name = random.choice(NAMES) if app.chance(0.2) else "grown"
    lines = [f"  {one}{_comment(app)}" for one in statements]
    head = "pluto 1\n" + ("use std as s\n" if app.chance(0.02) else "")
    return "\n".join([f"{head}app {name}{title} {{", *lines, "}", ""])


def _comment(app: Growth) -> str:
    return f"  # {app.random.choice(HOSTILE)}" if app.chance(0.05) else ""


def _settings(app: Growth) -> None:
    """Most are good; a text of any characters is hardly ever a requirement."""
    if app.chance(0.6):
        app.declared.append(f'version "{app.random.choice(VERSIONS)}"')
    if app.chance(0.6):
        many = app.random.choice((1, 1, 2, 6))
        required = [f'"{one}"' for one in app.random.choices(REQUIREMENTS, k=many)]
        required += [text(app.random)] * app.chance(0.1)
        app.declared.append(f"requires {', '.join(required)}")


def _fields(app: Growth) -> None:
    """Nearly all names are good ones; a field may be declared twice."""
    for _ in range(app.random.choice((1, 1, 2, 4))):
        written: list[str] = []
        for _ in range(app.random.choice((1, 1, 2, 5))):
            names = FIELD_NAMES if app.chance(0.1) else FIELD_NAMES[:10]
            kind = app.random.choice(TYPES) if app.chance(0.98) else "photo"
            default = f" = {app.value(kind)}" if kind != "photo" and app.chance(0.6) else ""
            written.append(
                f"{app.random.choice(names)}_{len(app.declared)}{len(written)}: {kind}{default}"
            )
            if app.chance(0.1):
                written[-1] = f"{app.random.choice(names)}: {kind}{default}"
        comma = "," if app.chance(0.1) else ""
        app.declared.append(
            f"{app.random.choice(('mission', 'trip'))} has {', '.join(written)}{comma}"
        )


def _categories(app: Growth) -> None:
    actions = ["measure", "take_photo", "pick_item", "release_item"]
    for i in range(app.random.choice((0, 1, 2))):
        name = app.name(f"act{i}")
        parameters, _ = app.parameters()
        repeat = app.random.choice(("", " safe", " once", " ask"))
        result = app.random.choice(RESULTS)
        tail = f"{repeat}{result}" if app.chance(0.2) else f"{result}{repeat}"
        app.declared.append(f"action {name}{parameters}{tail}")
        actions.append(name)
    for i in range(app.random.choice((1, 2))):
        kinds = {"payload": "mass", "speed": "speed", "flight_time": "time", "reserve": "percent"}
        given = [f"{key}: {app.value(kind)}" for key, kind in kinds.items() if app.chance(0.2)]
        can = app.random.sample(actions, app.random.randint(1, len(actions)))
        arguments = f"({', '.join(given)})" if given else ""
        app.declared.append(f"category {app.name(f'drone{i}')}{arguments} can {', '.join(can)}")


def _graph(app: Growth) -> None:
    """A mission's way as most apps have it, and now and then something more on it."""
    policy = app.random.choice(app.policies)
    if policy == "own":
        policy = app.name("choose")
        app.declared.append(f"policy {policy}")
    create = app.block("create", "MissionCreator")
    allocate = app.block("allocate", "DroneAllocator", f"policy: {policy}")
    launch = app.block("launch", "TripLauncher")
    again = app.block("wait", "Clock") if app.chance(0.4) else allocate
    before = app.before()
    way = [create, *before, *([again] if again != allocate else []), allocate, launch]
    app.flows.append(f"start -> {' -> '.join(way)}")
    last = _flight(app, launch)
    app.flows.append(f"{last} -> {again} when STANDBY")
    if app.chance(0.8):
        bound = app.random.choice(app.bounds)
        retry = app.block("retry", "PriorityManager", *([bound] if bound else []))
        app.flows += [f"{last} -> {retry} when FAILED", f"{retry} -> {again} when STANDBY"]
        app.flows.append(f"{retry} -> end otherwise")
    else:
        app.flows.append(f"{last} -> end when FAILED")
    _ending(app, last, again)


def _events(app: Growth) -> None:
    """Events, and what makes missions of one: where it leads to is nearly always well."""
    parameters, _ = app.parameters()
    event = app.name("seen")
    hook = app.name("look_after")
    app.declared += [f"event {event}{parameters}", f"creator {hook}"]
    check = app.block("check", "MissionCreator", f"hook: {hook}")
    source = event if app.chance(0.8) else app.random.choice(("late", "lost", "start"))
    app.flows.append(f"{source} -> {check} -> {app.random.choice(('allocate', 'launch'))}")
    if app.chance(0.3):
        app.declared.append(f"action {app.name('on_the_way')}{app.random.choice(RESULTS)} along")


def _flight(app: Growth, launch: str) -> str:
    """The monitors, and the gate behind them; return the block from which a mission goes on."""
    watch = app.block("watch", "TripMonitor")
    beside = app.beside()
    if not beside:
        app.flows.append(f"{launch} -> {watch}")
        return watch
    branches = [watch]
    for i, kind in enumerate(beside):
        if kind == "modifier":
            branches.append(_modifier(app, "STANDBY", "COMPLETED", "FAILED"))
        elif kind == "TimerMonitor" and not isinstance(app, Calm) and app.chance(0.2):
            event = app.random.choice(("late", "lost", "late, of: any", "seen", "late, of: own"))
            branches.append(app.block(f"limit{i}", "EventMonitor", f"event: {event}"))
        else:
            limit = app.limit() if kind != "TripMonitor" else ""
            branches.append(app.block(f"limit{i}", kind, *([limit] if limit else [])))
    gate = app.block("first", app.random.choice(app.gates))
    app.flows.append(f"{launch} -> [{', '.join(branches)}] -> {gate}")
    return gate


def _modifier(app: Growth, *emits: str) -> str:
    hook = app.name("change")
    parameters, needed = app.parameters()
    emitted = f" emits {', '.join(emits)}" if emits[-1] == "FAILED" or app.chance(0.2) else ""
    writes = f" writes {app.random.choice(('note', 'trips', 'priority'))}" * app.chance(0.2)
    app.declared.append(f"modifier {hook}{parameters}{emitted}{writes}")
    given = [f"{name}: {app.value(kind)}" for name, kind in needed]
    return app.block("modify", "MissionModifier", f"hook: {hook}", *given)


def _ending(app: Growth, last: str, again: str) -> None:
    if app.chance(0.5):
        hook = app.name("judge_it")
        parameters, needed = app.parameters()
        app.declared.append(f"evaluator {hook}{parameters}")
        given = [f"{name}: {app.value(kind)}" for name, kind in needed]
        judge = app.block("judge", "MissionEvaluator", f"hook: {hook}", *given)
        if app.chance(0.2) and not isinstance(app, Calm):
            app.declared.append(f"evaluator {app.name('other_judge')}{app.parameters()[0]}")
        app.flows += [f"{last} -> {judge} when COMPLETED", f"{judge} -> {again} when STANDBY"]
        app.flows.append(f"{judge} -> end when FAILED")
        last = judge
    if app.chance(0.4):
        repeat = app.block("again", "MissionRepeater")
        app.flows += [f"{last} -> {repeat} when COMPLETED", f"{repeat} -> {again} when STANDBY"]
        last = repeat
    app.flows.append(f"{last} -> end when COMPLETED")
