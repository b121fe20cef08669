"""`pluto-fleet calibrate`: how the drones of flown journals move, and `[motion]` of a fleet file by that."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..calibration.commands import read_all
from ..calibration.fit import calibrated
from ..calibration.report import as_data, report, write
from ..files.reading import PlanTable, parsed, text_of
from ..process.exit_code import BAD_INPUT
from ..shared import output
from ..shared.alone.files import read_motion
from ..shared.domain.errors import BadInput
from ..shared.domain.motion import CRAZYFLIE
from .options import Options, reader_of

if TYPE_CHECKING:
    from ..calibration.commands import Flights
    from ..shared.domain.motion import Motion

_ABOUT = """Finds how drones really move, from the journals of their flights: their pace, what they take beside
their ways, how much that varies, and their batteries; and how long actions of an app's own took."""

NOTHING_FOUND = 1


def main(argv: Sequence[str]) -> int:
    """Run the command, and return its exit code."""
    try:
        options = reader_of("calibrate", "pluto-fleet calibrate", _ABOUT).parse_args(
            argv, namespace=Options()
        )
    except SystemExit as end:  # argparse has printed the help, or what is wrong
        return end.code if isinstance(end.code, int) else BAD_INPUT
    return calibrate(options)


def calibrate(options: Options) -> int:
    """Print what was found, and write it if so asked; return 1 if nothing was found."""
    journals = read_all(options.journals)
    text = None if options.write is None else text_of(options.write)
    what = calibrated(journals, _model(options, text, journals))
    if options.json:
        output.line(json.dumps(as_data(what, journals)))
    else:
        for line in report(what, journals):
            output.line(line)
    if not what.found:
        return NOTHING_FOUND
    if options.write is not None and text is not None:
        changes = list(write(what, options.write, text))
        for line in changes:
            (output.tell if options.json else output.line)(line)
    return 0


def _model(options: Options, text: str | None, journals: Sequence[Flights]) -> Motion:
    """Return how the drones are said to move so far."""
    if options.fleet is not None:
        given = _motion(str(options.fleet), text_of(options.fleet))
        if text is not None:
            _agree(given, _motion(str(options.write), text), options)
        return given
    if text is not None:
        return _motion(str(options.write), text)
    first = journals[0]
    if first.fleet is None:
        return CRAZYFLIE
    return _motion(f"the fleet file in {first.path}", first.fleet)


def _agree(given: Motion, target: Motion, options: Options) -> None:
    """Refuse values that mean something else in the other file."""
    for key in ("legs", "limit", "taper"):
        if getattr(given, key) != getattr(target, key):
            raise BadInput(
                f"{options.fleet} and {options.write} differ in {key} of [motion]: what is found by the one"
                " does not hold for the other; leave out --fleet"
            )


def _motion(called: str, text: str) -> Motion:
    document = parsed(called, text)
    motion = read_motion(PlanTable(document, document.data))
    document.refuse_if_bad()
    return motion
