"""A small reading of Pluto's graphs: enough for the oracle and the mutants, and nothing else.

It shares no code with the compiler, so that one mistake cannot sit in both. Everything that is no
block and no arrow (categories, actions, hooks) is carried along as it stands.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise, product
from pathlib import Path

from tests.paths import EXAMPLES
from tests.soundness.kinds import (
    ACCEPTS,
    BUILT_IN_EVENTS,
    END_ACCEPTS,
    FIVE,
    GUARDED,
    Status,
)

START = "start"
END = "end"

OTHERWISE = "otherwise"
MODIFIER = re.compile(r"modifier (\w+).*?(?: emits ([A-Z, ]+))?(?: writes [a-z_, ]+)?")
EVENT = re.compile(r"event (\w+)(?:\(.*\))?")
BLOCK = re.compile(r"(\w+) = (\w+)(\(.*\))?")
FLOW = re.compile(r"(.+?)(?: when ([A-Z, ]+)| (otherwise))?")


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A block, with the parameters that its runs depend on."""

    name: str
    kind: str
    written: str
    """Its parameters in brackets, as they stand."""
    emits: tuple[Status, ...]
    """What a modifier's hook declares; empty: the status stays."""
    limit: int
    """How often a trip is flown before its failure goes on; 0: as often as it takes."""
    event: str = ""
    """What a monitor of events waits for."""
    hook: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """One edge; a bracket in the source is several."""

    source: str
    target: str
    guard: tuple[Status, ...]
    """Empty: none."""
    otherwise: bool

    def __str__(self) -> str:
        guard = f" when {', '.join(self.guard)}" if self.guard else ""
        return f"{self.source} -> {self.target}{guard}{' otherwise' if self.otherwise else ''}"


@dataclass(frozen=True, kw_only=True)
class App:
    """The graph of an app."""

    name: str
    rest: tuple[str, ...]
    """Declarations that are no blocks."""
    blocks: tuple[Block, ...]
    arrows: tuple[Arrow, ...]

    @property
    def sources(self) -> tuple[str, ...]:
        """Where missions come from: `start`, and the events that no block hides."""
        declared = [match[1] for line in self.rest if (match := EVENT.fullmatch(line))]
        names = {block.name for block in self.blocks}
        return (START, *(event for event in (*declared, *BUILT_IN_EVENTS) if event not in names))

    @property
    def text(self) -> str:
        """The app as Pluto, a statement an edge."""
        blocks = [f"{block.name} = {block.kind}{block.written}" for block in self.blocks]
        lines = [*self.rest, *blocks, *(str(arrow) for arrow in self.arrows)]
        return "\n".join(["pluto 1", f"app {self.name} {{", *(f"  {x}" for x in lines), "}", ""])


def read(text: str) -> App:
    """Return the graph of a well-formed app."""
    name, rest = "", []
    blocks: list[Block] = []
    arrows: list[Arrow] = []
    emits: dict[str, tuple[Status, ...]] = {}
    statements = _statements(text)
    for statement in statements:
        if match := MODIFIER.fullmatch(statement):
            emits[match[1]] = _statuses(match[2])
    for statement in statements:
        if statement.startswith("app "):
            name = statement.split()[1]
        elif "->" in statement and not statement.startswith("action "):
            arrows.extend(_arrows(statement))
        elif match := BLOCK.fullmatch(statement):
            blocks.append(_block(match[1], match[2], match[3] or "", emits))
        elif statement not in ("pluto 1", "}"):
            rest.append(statement)
    return App(name=name, rest=tuple(rest), blocks=tuple(blocks), arrows=tuple(arrows))


def thesis_graphs() -> dict[str, App]:
    """Return the graphs of the thesis by name, always in the same order: our examples, and what else it draws."""
    examples = sorted(EXAMPLES.glob("*/app.pluto"))
    drawn = sorted(Path(__file__).with_name("graphs").glob("*.pluto"))
    graphs = {
        **{path.parent.name: read(path.read_text(encoding="utf-8")) for path in examples},
        **{path.stem: read(path.read_text(encoding="utf-8")) for path in drawn},
    }
    assert len(graphs) == len(examples) + len(drawn), "two graphs have one name"
    return graphs


def takes(app: App) -> dict[Arrow, tuple[Status, ...]]:
    """Return the statuses that each arrow takes."""
    kinds = {block.name: block.kind for block in app.blocks}

    def accepted(name: str) -> tuple[Status, ...]:
        return END_ACCEPTS if name == END else ACCEPTS[kinds[name]]

    found = {arrow: arrow.guard or accepted(arrow.target) for arrow in app.arrows}
    for arrow in app.arrows:
        if is_rest(arrow):
            others = [a for a in app.arrows if a.source == arrow.source and not is_rest(a)]
            gone = [status for other in others for status in found[other]]
            found[arrow] = tuple(s for s in accepted(arrow.target) if s not in gone)
    return found


def allowed(app: App, target: str) -> tuple[Status, ...]:
    """Return the statuses that a guard may name before this target."""
    if target == END:
        return END_ACCEPTS
    kind = next(block.kind for block in app.blocks if block.name == target)
    return (*ACCEPTS[kind], *GUARDED.get(kind, ()))


def is_rest(arrow: Arrow) -> bool:
    """Return whether an arrow takes what is left; one to `end` without a guard does."""
    return arrow.otherwise or (arrow.target == END and not arrow.guard)


def _statements(text: str) -> list[str]:
    found: list[str] = []
    for line in text.splitlines():
        line = re.sub(r'^((?:[^"#]|"[^"]*")*)#.*', r"\1", line).strip()
        opened = found and found[-1].count("(") + found[-1].count("[") > (
            found[-1].count(")") + found[-1].count("]")
        )
        if found and (opened or line.startswith("->")):
            found[-1] += f" {line}"
        elif line:
            found.append(line)
    return found


def _block(name: str, kind: str, written: str, emits: dict[str, tuple[Status, ...]]) -> Block:
    hook = re.search(r"hook: (\w+)", written)
    limit = re.search(r"max_attempts: (\d+)", written)
    return Block(
        name=name,
        kind=kind,
        written=written,
        emits=emits.get(hook[1], ()) if hook else (),
        limit=int(limit[1]) if limit else 3,
        event=event[1] if (event := re.search(r"event: (\w+)", written)) else "",
        hook=hook[1] if hook else "",
    )


def _arrows(statement: str) -> list[Arrow]:
    match = FLOW.fullmatch(statement)
    assert match, statement
    stops = [re.findall(r"\w+", stop) for stop in match[1].split("->")]
    pairs = [
        (source, target, index == len(stops) - 2)
        for index, (left, right) in enumerate(pairwise(stops))
        for source, target in product(left, right)
    ]
    guard = _statuses(match[2])
    return [
        Arrow(
            source=source,
            target=target,
            guard=guard if last else (),
            otherwise=last and match[3] == OTHERWISE,
        )
        for source, target, last in pairs
    ]


def _statuses(names: str | None) -> tuple[Status, ...]:
    named = (names or "").replace(",", " ").split()
    return tuple(status for status in FIVE if status in named)
