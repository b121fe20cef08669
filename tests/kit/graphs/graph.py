"""Random apps: drawn so that most are sound, and so that all that a graph can hold turns up often."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from tests.kit.graphs.asides import aside, beside, judged, retried, tangle
from tests.kit.graphs.drawing import END, START, Drawing, Ends, F, R, S, Statuses, U
from tests.kit.graphs.flights import flight

BOTH = (U, S)
POLICIES = ("", "", "nearest", "first", "least_used", "batch_optimal", "own", "own")
CATEGORIES = (
    (),
    (),
    ("scout", "carrier(payload: 5 g)"),
    ("fast(speed: 1 m/s, flight_time: 2 min, charge_time: 1 min)",),
    ("weak(flight_time: 90 s, charge_time: 2 min, reserve: 10 %)", "slow"),
)
BUILT_IN = ("measure", "take_photo", "pick_item", "release_item")
ACTIONS = (
    "action spray(dose: mass = 50 mg) once",
    "action scan safe",
    "action open(how: text) ask",
)


FIELDS = (
    "mission has owner: text, notes: int = 0",
    "trip has layers: int = 1, gentle: bool",
    'trip has remark: text = "", share: percent = 20 %',
)
EVENTS = ("event smoke(level: int = 0)", "event seen")
ON_THE_WAY = ("action look along", "action take_photo along")
RESULTS = ("", "", " -> int", " -> float", " -> text")


def random_source(
    rng: Random,
    most: Sequence[int] = (6, 9, 12, 16, 20),
    *,
    strange: float = 0.15,
    plain: bool = False,
    events: Random | None = None,
) -> str:
    """Return an app, sound or not, of about so many blocks.

    Some use another author's blocks, too; a plain one has nothing of its own but modifiers and evaluators. With a luck
    for `events` it is the same app in which they happen.
    """
    most_blocks = rng.choice(most)
    is_strange = rng.random() < strange
    drawing = Drawing(rng=rng, most=most_blocks, strange=is_strange, plain=plain, events=events)
    return _Graph(drawing).text()


class _Graph:
    """An app: a way to a drone, a flight, and what becomes of the mission then."""

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.policies: list[str] = []
        self.heads: list[str] = []
        """Where a mission can go on with its next trip."""
        self.launched = ""

    def text(self) -> str:
        drawing = self.drawing
        if not drawing.plain:
            self._words()
        create = drawing.block("create", "MissionCreator", (U,))
        drawing.arrows.append((START, create, (U,)))
        ends: Ends = {create: (U,)}
        if drawing.chance(0.1):
            ends = aside(drawing, ends)
        astray = self._to_a_drone(ends)
        ends = flight(drawing, self._launch({self.heads[-1]: BOTH}))
        for block, statuses in astray.items():
            ends[block] = (*ends.get(block, ()), *statuses)
        self._home(ends)
        luck = Random(f"{len(drawing.words)}/{len(drawing.blocks)}")
        if not drawing.plain:
            drawing.words += [one for one in FIELDS if luck.random() < 0.4]
        self._made_of_events()
        return drawing.text()

    def _made_of_events(self) -> None:
        """Draw what makes missions of events, and where they begin."""
        drawing = self.drawing
        if drawing.events is None:
            return
        drawing.words += EVENTS
        for event in ("smoke", "seen", "late", "lost"):
            if drawing.happens(0.4):
                hook = drawing.hook("creator", "react")
                check = drawing.block("check", "MissionCreator", (U,), f"hook: {hook}")
                drawing.arrows.append((event, check, (U,)))
                drawing.lead({check: (U,)}, drawing.events.choice(self.heads))

    def _words(self) -> None:
        """Declare what drones there are, and what they do."""
        drawing = self.drawing
        own = [action for action in ACTIONS if drawing.chance(0.35)]
        names = [*BUILT_IN, *(action.split("(")[0].split()[1] for action in own)]
        if drawing.events is not None:
            drawing.words += [one for one in ON_THE_WAY if drawing.happens(0.6)]
            names.append("follow")
        for category in drawing.rng.choice(CATEGORIES):
            can = [name for name in names if drawing.chance(0.9)] or names
            drawing.words.append(f"category {category} can {', '.join(can)}")
        # by a luck of its own: the rest is drawn as before these were there
        luck = Random(f"{len(drawing.words)}/{len(own)}/{drawing.most}/{len(names)}")
        drawing.words += [
            f"{one.rpartition(' ')[0]}{luck.choice(RESULTS)} {one.split()[-1]}" for one in own
        ]

    def _to_a_drone(self, ends: Ends) -> Ends:
        """Draw what leads to the first allocator; return what goes astray on the way."""
        drawing = self.drawing
        known, astray = len(drawing.blocks), dict[str, Statuses]()
        while drawing.chance(0.5) and len(self.heads) < 3:
            before, drawn = len(drawing.blocks), drawing.rng.random()
            if drawn < 0.5:
                ends = drawing.into(ends, drawing.block("wait", "Clock", ()))
            elif drawn < 0.75:
                ends = drawing.into(ends, drawing.modifier("prepare"))
            elif drawn < 0.85:
                ends = aside(drawing, ends)
            else:
                out = tangle(drawing, ends)
                astray |= _some(out, (F,))
                ends = _some(out, BOTH)
            self.heads.append(list(drawing.blocks)[before])
        drawing.into(ends, self._allocator())
        self._come_back_to(list(drawing.blocks)[known:])
        return astray

    def _come_back_to(self, blocks: list[str]) -> None:
        """Let through those that come back with a trip behind them, too."""
        drawing = self.drawing
        plain = [block for block in blocks if drawing.emits[block] in ((U,), ())]
        drawing.emits |= dict.fromkeys(plain, BOTH)
        drawing.arrows = [
            (source, target, BOTH if source in plain else statuses)
            for source, target, statuses in drawing.arrows
        ]

    def _allocator(self) -> str:
        drawing = self.drawing
        policy = drawing.rng.choice(POLICIES[: 6 if drawing.plain else None])
        if policy == "own":
            if not self.policies or drawing.chance(0.4):
                self.policies.append(drawing.hook("policy", "choose"))
            policy = drawing.rng.choice(self.policies)
        written = [f"policy: {policy}"] if policy else []
        if drawing.chance(0.25):
            written.append(f"allocate_within: {drawing.seconds()}")
        self.heads.append(drawing.block("allocate", "DroneAllocator", (), ", ".join(written)))
        return self.heads[-1]

    def _launch(self, ends: Ends) -> Ends:
        if self.drawing.chance(0.12):
            ends = aside(self.drawing, ends)
        self.launched = self.drawing.block("launch", "TripLauncher", (R,))
        return self.drawing.into(ends, self.launched)

    def _home(self, ends: Ends) -> None:
        """Lead what comes of a flight to the next one, or to the end."""
        drawing = self.drawing
        for share, draw in (
            (0.12, tangle),
            (0.15, aside),
            (0.4, judged),
            (0.2, beside),
            (0.5, retried),
            (0.15, aside),
        ):
            if drawing.chance(share) and ends and (draw in (retried, beside) or not drawing.full):
                ends = draw(drawing, ends)
        other = self._other_way() if drawing.chance(0.35) else ""
        for block, statuses in ends.items():
            for status in statuses:
                if other and status in (S, F) and drawing.chance(0.5):
                    drawing.lead({block: (status,)}, other)
                elif status in BOTH:
                    drawing.lead({block: (status,)}, drawing.rng.choice(self.heads))
                elif status is F and drawing.chance(0.15):
                    drawing.lead({block: (status,)}, self.heads[-1])
                elif not drawing.chance(0.04):
                    drawing.lead({block: (status,)}, END)

    def _other_way(self) -> str:
        """Draw a second allocator, and now and then a launch and a flight of its own behind it."""
        drawing = self.drawing
        other = self._allocator()
        drawing.emits[other] = BOTH
        if drawing.full or drawing.chance(0.6):
            drawing.lead({other: BOTH}, self.launched)
        else:
            for block, statuses in flight(drawing, self._launch({other: BOTH}), 1).items():
                for status in statuses:
                    target = drawing.rng.choice(self.heads) if status is S else END
                    drawing.lead({block: (status,)}, target)
        return other


def _some(ends: Ends, statuses: Statuses) -> Ends:
    found = {block: tuple(s for s in each if s in statuses) for block, each in ends.items()}
    return {block: each for block, each in found.items() if each}
