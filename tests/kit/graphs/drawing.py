"""A Pluto source that grows a block at a time: what is declared, and who leads where."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from plutoc.block import IN_GRAPH, Block
from plutoc_blocks import BLOCKS
from plutoc_runtime.domain.status import Status
from tests.kit.graphs import others

U, R, S, C, F = IN_GRAPH
START, END = "start", "end"
KINDS: Mapping[str, Block] = {
    **{block.name: block for block in BLOCKS},
    **{f"{others.PACKAGE}.{name}": block for name, block in others.BLOCKS.items()},
}

Statuses = tuple[Status, ...]
Ends = dict[str, Statuses]
"""Blocks whose missions do not know yet where to go on, with their statuses."""


def ordered(statuses: Iterable[Status]) -> Statuses:
    """Return each status once, in declared order."""
    found = set(statuses)
    return tuple(status for status in IN_GRAPH if status in found)


@dataclass(kw_only=True)
class Drawing:
    """The lines so far."""

    rng: Random
    most: int
    """How many blocks it should have, about."""
    strange: bool = False
    """It uses another author's blocks, too."""
    plain: bool = False
    """It has no actions, fields, policies and parameters of its own."""
    events: Random | None = None
    """The luck by which events happen in it; None: none do. The rest is drawn as without them."""
    words: list[str] = field(default_factory=list)
    """Categories, actions and hooks."""
    blocks: dict[str, str] = field(default_factory=dict)
    """The declarations by name."""
    kinds: dict[str, str] = field(default_factory=dict)
    emits: dict[str, Statuses] = field(default_factory=dict)
    arrows: list[tuple[str, str, Statuses]] = field(default_factory=list)

    @property
    def full(self) -> bool:
        """Whether it is time to come to an end."""
        return len(self.blocks) >= self.most

    def chance(self, share: float) -> bool:
        """Let it happen in this share of cases."""
        return self.rng.random() < share

    def happens(self, share: float) -> bool:
        """Let something of events be in this share of cases."""
        return self.events is not None and self.events.random() < share

    def block(self, name: str, kind: str, emits: Iterable[Status], written: str = "") -> str:
        """Declare a block, and return its name, with a number behind it."""
        numbered = f"{name}{len(self.blocks)}"
        self.blocks[numbered] = f"{numbered} = {kind}{f'({written})' if written else ''}"
        self.kinds[numbered] = kind
        self.emits[numbered] = ordered(emits)
        return numbered

    def hook(self, kind: str, name: str, written: str = "") -> str:
        """Declare a hook, and return its name, with a number behind it."""
        numbered = f"{name}{len(self.words)}"
        self.words.append(f"{kind} {numbered}{written}")
        return numbered

    def modifier(self, name: str, emits: Statuses = ()) -> str:
        """Declare a modifier with its hook; the statuses that come in go on if it emits none."""
        limited = self.chance(0.2) and not self.plain
        takes = "(limit: time = 2 s)" if limited else ""
        said = f" emits {', '.join(status.value for status in emits)}" if emits else ""
        hook = self.hook("modifier", f"do_{name}", takes + said)
        given = f", limit: {self.seconds()}" if limited and self.chance(0.6) else ""
        return self.block(name, "MissionModifier", emits, f"hook: {hook}{given}")

    def seconds(self) -> str:
        """Return some time in whole and half seconds: so that many things fall on one instant."""
        return f"{self.rng.choice((0, 1, 2, 3, 4, 5, 8, 12, 16, 24, 30, 40, 60, 90)) / 2:g} s"

    def lead(self, ends: Ends, target: str, only: Statuses = IN_GRAPH) -> Ends:
        """Lead these to a block, as far as they have these statuses; return the other ends."""
        left: Ends = {}
        for block, statuses in ends.items():
            going = tuple(status for status in statuses if status in only)
            staying = tuple(status for status in statuses if status not in only)
            if going:
                self.arrows.append((block, target, going))
            if staying:
                left[block] = staying
        return left

    def into(self, ends: Ends, block: str) -> Ends:
        """Lead all ends to a block that emits what it takes, or what it has declared."""
        self.lead(ends, block)
        statuses = self.emits[block] or ordered(s for each in ends.values() for s in each)
        self.emits[block] = statuses
        return {block: statuses}

    def text(self, title: str = "drawn") -> str:
        """Return the source."""
        lines = [*self.words, *self.blocks.values(), *self._flow()]
        uses = [f"use {others.PACKAGE}"] if self.strange else []
        inner = [f"  {line}" for line in lines]
        return "\n".join(["pluto 1", *uses, f"app {title} {{", *inner, "}", ""])

    def _flow(self) -> Iterable[str]:
        sources = dict.fromkeys(source for source, _, _ in self.arrows)
        for source in sources:
            ways: dict[str, list[Status]] = {}
            for one, target, statuses in self.arrows:
                if one == source:
                    ways.setdefault(target, []).extend(statuses)
            yield from self._written(source, {to: ordered(found) for to, found in ways.items()})

    def _written(self, source: str, ways: Mapping[str, Statuses]) -> Iterable[str]:
        """Write the arrows of a block: with guards, without where that says the same."""
        if source not in self.blocks:  # missions come from there
            yield from (f"{source} -> {target}" for target in ways)
            return
        emits = self.emits[source]
        bare: list[str] = []
        taken: set[Status] = set()
        last = next((to for to in ways if to == END), list(ways)[-1])
        for target, statuses in ways.items():
            if target == last:
                continue
            if self._would_take(target, emits) == statuses and self.chance(0.6):
                bare.append(target)
                taken.update(self._accepted(target))
            else:
                yield f"{source} -> {target} when {_named(statuses)}"
                taken.update(statuses)
        rest = tuple(s for s in self._would_take(last, emits) if s not in taken)
        if last == END and rest == ways[last]:
            yield f"{source} -> {END}"
        elif rest == ways[last] and taken and self.chance(0.5):
            yield f"{source} -> {last} otherwise"
        elif self._would_take(last, emits) == ways[last] and last != END:
            bare.append(last)
        else:
            yield f"{source} -> {last} when {_named(ways[last])}"
        if len(bare) > 1 and self.chance(0.7):
            yield f"{source} -> [{', '.join(bare)}]"
        else:
            yield from (f"{source} -> {target}" for target in bare)

    def _would_take(self, target: str, emits: Statuses) -> Statuses:
        return tuple(status for status in emits if status in self._accepted(target))

    def _accepted(self, target: str) -> Sequence[Status]:
        return (C, F) if target == END else ordered(KINDS[self.kinds[target]].accepts)


def _named(statuses: Statuses) -> str:
    return ", ".join(status.value for status in statuses)
