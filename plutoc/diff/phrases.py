"""What the sentences are made of: who a mission is that leaves a block, and what becomes of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from plutoc.check.facts import bound_of
from plutoc.diff.both import Side
from plutoc.diff.roles import Role, awaited, role
from plutoc.graph.model import END, Node
from plutoc_runtime.domain.quantities import QUANTITIES, UNITS, Type, to_si, units_of
from plutoc_runtime.domain.status import Status

_MOST_WORDS = 12


class Phrase(NamedTuple):
    """Something that happens to a mission; `~` is where `now` or `no longer` stands."""

    does: str
    did: str
    detail: str = ""
    """What is of no interest where it happens no longer."""

    def __str__(self) -> str:
        return self.does.replace("~", "") + self.detail

    @property
    def now(self) -> str:
        """What happens now and did not before."""
        return self.does.replace("~", "now ") + self.detail

    @property
    def no_longer(self) -> str:
        """What happened before and does not now, in as few words as will do."""
        return self.does.replace("~", "no longer ")

    @property
    def before(self) -> str:
        """What happened before and does not now."""
        return self.did + self.detail


def named(names: Iterable[str], last: str = "and") -> str:
    """`watch`, `timer` and `first`, each in backquotes."""
    return listed([f"`{name}`" for name in names], last)


def a_kind(kind: str) -> str:
    """`an `EventMonitor``, `a `Clock``."""
    return f"{'an' if kind[:1] in 'AEIOU' else 'a'} `{kind}`"


def listed(words: Sequence[str], last: str = "and") -> str:
    """Write words one after the other; of many, the first and how many more there are."""
    if len(words) > _MOST_WORDS:
        words = [*words[: _MOST_WORDS - 1], f"{len(words) - _MOST_WORDS + 1:,} more"]
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}"


def so_often(bound: int) -> str:
    """Say how often a trip is flown; 0 is no bound."""
    if not bound:
        return " without a bound"
    return f" up to {bound} times (flights of a trip, the first included)"


def missions_of(side: Side, node: Node, statuses: Sequence[Status]) -> str:
    """Say which mission leaves a block with these statuses: `a FAILED mission`."""
    match role(node), tuple(statuses):
        case Role.CREATES, _:
            return "a new mission"
        case Role.WATCHES | Role.LIMITS | Role.INTERRUPTS, (Status.STANDBY,):
            who = "a mission with trips left"
        case Role.WATCHES | Role.LIMITS | Role.INTERRUPTS, (status,):
            who = f"a {status.value} mission"
        case Role.EVALUATES, (Status.STANDBY,):
            who = "a mission judged to need more trips"
        case Role.EVALUATES, (Status.COMPLETED,):
            who = "a mission judged to be complete"
        case Role.EVALUATES, (Status.FAILED,):
            who = "a mission judged a failure"
        case Role.REPEATS, (Status.STANDBY,):
            who = "a mission with another round to fly"
        case Role.REPEATS, (Status.COMPLETED,):
            who = "a mission without another round to fly"
        case Role.RETRIES, (Status.STANDBY,):
            who = "a mission whose failed trip was put back"
        case Role.RETRIES, (Status.FAILED,):
            who = "a mission whose trip has failed too often"
        case Role.ALLOCATES, _:
            who = f"{_some(side, node, statuses)} that has got a drone"
        case Role.HOLDS, _:
            what = awaited(node)
            waited = f"for its {what}" if what else f"at `{node.name}`"
            who = f"{_some(side, node, statuses)} that has waited {waited}"
        case Role.LAUNCHES, _:
            who = "a mission in flight"
        case _:
            said = listed([status.value for status in statuses], "or")
            return f"a mission that leaves `{node.name}` {said}"
    named_already = side.is_only(node) or f"`{node.name}`" in who
    return who if named_already else f"{who} at `{node.name}`"


def _some(side: Side, node: Node, statuses: Sequence[Status]) -> str:
    """`a mission`, or `a STANDBY mission` where others leave the block as well."""
    if side.checked.leaves[node.name] <= set(statuses):
        return "a mission"
    first = listed([status.value for status in statuses], "or")
    return f"{'an' if first[0] in 'AEIOU' else 'a'} {first} mission"


def ahead(side: Side, names: Sequence[str], status: Status) -> Phrase:
    """Say what becomes of a mission that goes there with this status."""
    if len(names) != 1:
        where = named(names)
        return Phrase(f"is ~in {where} at once", f"was in {where} at once")
    (name,) = names
    if name == END:
        return Phrase("~ends", "ended")
    node = side.graph.node[name]
    found = _visited(node, status)
    if side.is_only(node) or f"`{name}`" in found.does:
        return found
    where = f" at `{name}`"
    return Phrase(found.does + where, found.did + where, found.detail)


def _retried(node: Node) -> Phrase:
    bound = bound_of(node)
    if bound == 1:
        through = f"through `{node.name}`, which allows a trip one flight only"
        return Phrase(f"~goes {through}", f"went {through}")
    return Phrase("is ~retried", "was retried", so_often(bound))


def _visited(node: Node, status: Status) -> Phrase:
    name = node.name
    match role(node):
        case Role.RETRIES if status is Status.FAILED:
            return _retried(node)
        case Role.ALLOCATES if status is Status.FAILED:
            return Phrase("is ~retried", "was retried", f" without a bound by `{name}`")
        case Role.ALLOCATES:
            return Phrase("~waits for a drone", "waited for a drone")
        case Role.HOLDS:
            what = awaited(node)
            wait = f"for the {what}" if what else f"at `{name}`"
            return Phrase(f"~waits {wait}", f"waited {wait}")
        case Role.LAUNCHES:
            return Phrase("is ~launched", "was launched")
        case Role.WATCHES | Role.LIMITS | Role.INTERRUPTS:
            return Phrase(f"is ~watched by `{name}`", f"was watched by `{name}`")
        case Role.EVALUATES if node.hook:
            by = f"judged by `{node.hook.name}`"
            return Phrase(f"is ~{by}", f"was {by}")
        case Role.EVALUATES:
            return Phrase("is ~judged", "was judged")
        case Role.REPEATS:
            if_asked = "another round if its user has asked for one"
            return Phrase(f"~begins {if_asked}", f"began {if_asked}")
        case Role.GATE:
            return Phrase(f"~comes to the gate `{name}`", f"came to the gate `{name}`")
        case Role.CALLS if node.hook:
            to = f"handed to `{node.hook.name}` at `{name}`"
            return Phrase(f"is ~{to}", f"was {to}")
        case _:
            to = f"to `{name}` (`{node.block.name}`)"
            return Phrase(f"~goes {to}", f"went {to}")


Plain = bool | int | float | str


def amount(value: Plain | None, kind: Type) -> str:
    """Write a value: `5 min`, `3`, `yes`, or a text in quotes."""
    match value:
        case None:
            return "none"
        case bool():
            return "yes" if value else "no"
        case str():
            return code(f'"{value}"')
        case _ if kind in QUANTITIES:
            return _quantity(float(value), kind)
        case _:
            return f"{value:.12g}"


def code(text: str) -> str:
    """Put a text into backquotes, as it can stand in a sentence: with none of its own."""
    return f"`{text.replace('`', chr(39))}`"


def _quantity(value: float, kind: Type) -> str:
    """Write a quantity with as few digits as will do; of two ways, in the larger unit."""
    written = []
    for unit in sorted(units_of(kind), key=lambda unit: -UNITS[unit][1]):
        _, factor, offset = UNITS[unit]
        number = f"{(value - offset) / factor:.12g}"
        if "e" not in number and to_si(float(number), unit) == value:
            odd = value == 0 and factor != 1  # nothing at all is 0 s, and not 0 h
            written.append((len(number), odd, f"{number} {unit}"))
    return min(written, key=lambda one: one[:2])[-1] if written else f"{value:.12g}"
