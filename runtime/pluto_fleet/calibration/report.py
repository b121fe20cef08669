"""What a calibration has found: for people, and for programs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import floor, log10
from typing import TYPE_CHECKING, Any

from ..report.terminal import table
from ..shared.domain.text import counted, number

if TYPE_CHECKING:
    from .commands import Flights
    from .found import Calibration, Found

IN_SECONDS = ("settles", "take_off", "landing")
NAMES = (
    "pace",
    "take_off",
    "settles",
    "landing",
    "spread",
    "action_spread",
    "drain",
    "charge",
)
"""What can be found, in the order in which it is shown: keys of `[motion]`, and `charge`."""

_SAID_OF_CHARGE = 1.0


def report(what: Calibration, journals: Sequence[Flights]) -> Iterator[str]:
    """Yield the lines for people."""
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
        f"{low.removesuffix(' %').removesuffix(' s')} … {high}",
        counted(found.count, found.of),
    )


def said(what: Calibration, name: str) -> float:
    """Return what the fleet file says so far."""
    return float(getattr(what.model, name, _SAID_OF_CHARGE))


def digits_of(name: str, found: Found) -> int:
    """Return how many decimals of a value mean something: two of its standard error."""
    error = found.estimate.error * (1 if name in IN_SECONDS else 100)
    return min(max(1 - floor(log10(error)), 0), 3) if error > 0 else 3


def written(name: str, value: float, digits: int | None = None) -> str:
    """Return a value as a fleet file has it, with its unit."""
    amount, unit = (value, "s") if name in IN_SECONDS else (100 * value, "%")
    return f"{number(amount) if digits is None else f'{amount:.{digits}f}'} {unit}"


def in_file(name: str, found: Found) -> str:
    """Return a value that was found as it is put into a fleet file."""
    factor = 1 if name in IN_SECONDS else 100
    return written(name, round(factor * found.value, digits_of(name, found)) / factor)


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
        "own_actions": [
            {
                "app": own.app,
                "name": own.name,
                "seconds": own.seconds,
                "interval": [own.low, own.high],
                "count": own.count,
                "planned": own.planned,
                "parameter": own.parameter,
            }
            for own in what.own
        ],
        "notes": what.notes,
    }
