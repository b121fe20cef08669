"""What is said of a plan that cannot be taken, kept or read: one function a sentence."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from plutoc_runtime.domain.errors import BadInput, PlutoError
from plutoc_runtime.domain.text import counted, printable, quoted

from ...files.errors import listed, shown


class Stale(PlutoError):
    """The plan has changed since: what was drawn was drawn on an old one."""


def stale(given: int, current: int) -> Stale:
    return Stale(f"the plan has been changed meanwhile: it is at {current}, not at {given}")


# The shape


def not_a_number(value: object) -> BadInput:
    return BadInput(f"the plan's revision {shown(value)} is not a whole number")


def wrong(where: str, value: object, wanted: str) -> BadInput:
    return BadInput(f"{where} {shown(value)} is not {wanted}")


def unknown_key(where: str, key: str, keys: Sequence[str]) -> BadInput:
    return BadInput(f"{where} has an unknown key {quoted(key)}; it may have: {listed(keys)}")


def missing_key(where: str, key: str) -> BadInput:
    return BadInput(f"{where} has no {key}")


def too_many(what: str, most: int) -> BadInput:
    return BadInput(f"a plan has at most {most} {what}")


def too_long(where: str, most: int) -> BadInput:
    return BadInput(f"{where} is longer than {most} characters")


def too_large(where: str) -> BadInput:
    return BadInput(f"{where} is too large a number")


def no_text(where: str) -> BadInput:
    return BadInput(f"{where} holds half a character: it is no text")


def key_twice(key: str) -> BadInput:
    return BadInput(f"two missions or trips have the key {quoted(key)}")


# What cannot be flown


def not_in_the_plan(key: str) -> BadInput:
    return BadInput(f"no mission of the plan has the key {quoted(key)}: look at the plan again")


def under_way(name: str) -> BadInput:
    return BadInput(
        f"mission {quoted(name)} belongs to the flight that is under way: it can be started again"
        " when that has ended"
    )


def not_ready(sentences: Sequence[str], most: int) -> BadInput:
    """Say what is still to be done, as far as it fits a message."""
    more = len(sentences) - most
    lines = [*sentences[:most], f"… and {counted(more, 'more problem')}"]
    return BadInput("\n".join(lines if more > 0 else sentences))


def no_example() -> BadInput:
    return BadInput(
        "no example could be made: no drone of the fleet can do anything anywhere on this map"
    )


# What is kept


def not_kept(path: Path, error: OSError) -> str:
    why = error.strerror or str(error)
    return (
        f"The plan could not be written to {_name(path)}: {why}. What you draw is not lost as long "
        "as this runs; it is written with the next change, if it can be by then."
    )


def not_a_plan(path: Path, why: str, aside: Path) -> str:
    return (
        f"The plan that was kept cannot be read: {why}. It lies in {_name(aside)}, "
        f"and {_name(path)} begins anew."
    )


def not_all_taken(aside: Path, keys: Sequence[str]) -> str:
    return (
        f"The plan that was kept has {listed(keys)}, which this app does not have any more. The "
        f"rest is here; as it was, it lies in {_name(aside)}."
    )


def in_the_way(path: Path, why: str, error: OSError) -> BadInput:
    return BadInput(
        f"{path}: the plan that was kept cannot be read ({why}), and cannot be put aside either: "
        f"{error.strerror or error}"
    )


def of_another_app(name: object, app: str) -> str:
    return f"it is of {shown(name)}, and this is {app}"


def not_json() -> str:
    return "it is damaged, or is something else"


def too_much() -> str:
    return "it is larger than any plan"


def unreadable(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _name(path: Path) -> str:
    return printable(str(path))
