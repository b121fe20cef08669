"""What a calibration has found: for people, for programs, and put into a fleet file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from math import floor, log10
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from ..files.reading import PlanTable, parsed
from ..process.whole_file import write_whole
from ..report.terminal import table
from ..shared.alone.files import read_motion
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number
from ..shared.domain.values import MOTION
from .commands import Flights
from .estimates import Calibration, Found

IN_SECONDS = ("settles", "take_off", "landing")
_UNITS = {**dict.fromkeys(IN_SECONDS, "s"), "up": "m/s", "down": "m/s", "touch_down": "m/s"}
BARE = {"acceleration": "m/s²", "jerk": "m/s³"}
"""What has a unit that a fleet file does not know, where it is a number."""
SPREADS = {"spread", "action_spread"}
NAMES = (
    *("pace", "take_off", "settles", "landing"),
    *("acceleration", "jerk", "up", "down", "touch_down"),
    *("spread", "action_spread", "drain", "charge"),
)
"""What can be found, in the order in which it is shown: keys of `[motion]`, and `charge`."""

_SAID_OF_CHARGE = 1.0


def report(what: Calibration, journals: Sequence[Flights]) -> Iterator[str]:
    yield _counts(what, journals)
    yield ""
    found = [(name, what.found[name]) for name in NAMES if name in what.found]
    if found:
        header = ("", "said", "found", "±", "95 % interval", "from")
        yield from table(header, [_row(what, *one) for one in found], right=(1, 2, 3))
    for name in NAMES:
        if name in what.untold:
            yield f"{name} cannot be told: {what.untold[name]}"
    if found:
        yield ""
        yield "± is the standard error; with 95 % probability all values are in their intervals at once"
    if "charge" in what.found:
        yield "charge is a share of the charge_time of the drones' categories, which the app says"
    for note in what.notes:
        yield f"note: {note}"


def _counts(what: Calibration, journals: Sequence[Flights]) -> str:
    drones = {one.drone for journal in journals for one in journal.commands}
    flown = (
        f"{counted(what.commands, 'command')} of {counted(len(drones), 'drone')}"
        f" in {counted(len(journals), 'journal')}"
    )
    apart = [
        f"{count} {how}"
        for count, how in (
            (what.broken_off, "broken off"),
            (what.failed, "failed"),
            (what.far_off, "far from all others"),
        )
        if count
    ]
    return f"{flown}; not counted: {', '.join(apart)}" if apart else flown


def _row(what: Calibration, name: str, found: Found) -> tuple[str, ...]:
    digits = digits_of(name, found)
    low, high = (written(name, end, digits) for end in (found.low, found.high))
    error = written(name, found.estimate.error, digits)
    if not any(digit in error for digit in "123456789"):
        error = f"< {error.replace('0.000', '0.001')}"
    return (
        name,
        written(name, said(what, name)),
        written(name, found.value, digits),
        error,
        f"{low.removesuffix(_unit(name)).rstrip()} … {high}",
        counted(found.count, found.of),
    )


def said(what: Calibration, name: str) -> float:
    """Return what the fleet file says so far."""
    return float(getattr(what.model, name, _SAID_OF_CHARGE))


def digits_of(name: str, found: Found) -> int:
    """Return how many decimals of a value mean something: two of its standard error."""
    error = found.estimate.error * _scale(name)
    return min(max(1 - floor(log10(error)), 0), 3) if error > 0 else 3


def written(name: str, value: float, digits: int | None = None) -> str:
    """Return a value with its unit, as a fleet file has it where that knows the unit."""
    amount = _scale(name) * value
    return f"{number(amount) if digits is None else f'{amount:.{digits}f}'} {_unit(name)}"


def _unit(name: str) -> str:
    return {**_UNITS, **BARE}.get(name, "%")


def _scale(name: str) -> int:
    return 100 if _unit(name) == "%" else 1


def in_file(name: str, found: Found) -> str | float:
    """Return a value that was found as it is put into a fleet file."""
    factor = _scale(name)
    value = round(factor * found.value, digits_of(name, found)) / factor
    return value if name in BARE else written(name, value)


def as_data(what: Calibration, journals: Sequence[Flights]) -> dict[str, Any]:
    """Return the same as plain data, in seconds and shares."""
    return {
        "journals": [str(journal.path) for journal in journals],
        "commands": what.commands,
        "not_counted": {
            "broken_off": what.broken_off,
            "failed": what.failed,
            "far_off": what.far_off,
        },
        "found": {
            name: {
                "said": said(what, name),
                "value": found.value,
                "error": found.estimate.error,
                "interval": [found.low, found.high],
                "count": found.count,
                "of": found.of,
            }
            for name in NAMES
            if (found := what.found.get(name)) is not None
        },
        "untold": what.untold,
        "own_actions": [asdict(own) for own in what.own],
        "notes": what.notes,
    }


def write(what: Calibration, path: Path, text: str) -> Iterator[str]:
    """Put the values into the `[motion]` of a fleet file with this text; yield what has changed.

    Raises `BadInput` if a value may not stand there, or the file cannot be written; then it is as before.
    """
    values = {name: in_file(name, found) for name, found in what.found.items() if name != "charge"}
    for name, why in _too_wide(values).items():
        yield f"{path}: [motion] {name} stays as it is: {values.pop(name)} {why}"
    changed, after = _changed(path, text, values)
    if after != text:
        file = Path(os.path.realpath(path))
        try:
            write_whole(file, after, mode=file.stat().st_mode & 0o777)
        except OSError as error:
            raise BadInput(f"{path}: it cannot be written: {error.strerror or error}") from None
    for name, before in changed.items():
        was = "" if before is None else f" (was {before})"
        yield f"{path}: [motion] {name} = {values[name]}{was}"
    if not changed:
        yield f"{path}: nothing has changed"


def _too_wide(values: Mapping[str, str | float]) -> dict[str, str]:
    """Return the spreads that may not stand in a fleet file, and why: what is expected does not hang on them."""
    refused: dict[str, str] = {}
    for name in SPREADS & values.keys():
        try:
            MOTION[name](values[name])
        except ValueError as error:
            refused[name] = str(error)
    return refused


def _changed(
    path: Path, text: str, values: dict[str, str | float]
) -> tuple[dict[str, object | None], str]:
    """Return the keys that change, with what they were, and the new text."""
    try:
        document: Any = tomlkit.parse(text)
    except TOMLKitError as error:  # `tomllib` has read it
        raise BadInput(f"{path}: it cannot be changed here: {error}") from None
    if "motion" not in document:
        document["motion"] = tomlkit.table()
    motion = document["motion"]
    changed: dict[str, object | None] = {}
    for name, value in values.items():
        before = motion.get(name)
        if before != value:
            changed[name] = None if before is None else before.unwrap()
            motion[name] = value
    after = tomlkit.dumps(document) if changed else text
    if text.count("\n") == text.count("\r\n") > 0:  # new lines end as all others do
        after = after.replace("\r\n", "\n").replace("\n", "\r\n")
    read = parsed(f"{path}, with what was found", after)
    read_motion(PlanTable(read, read.data))
    read.refuse_if_bad()
    return changed, after
