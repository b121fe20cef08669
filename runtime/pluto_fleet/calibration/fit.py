"""How the drones of flown journals move: what of `Motion` can be found, and how sure that is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..jobs.flown import ACTION, BROKEN_OFF, DONE
from .battery import find_battery
from .durations import find_actions, find_durations
from .found import Calibration
from .own_actions import find_own_actions

if TYPE_CHECKING:
    from ..shared.domain.motion import Motion
    from .commands import Flights


def calibrated(journals: Sequence[Flights], model: Motion) -> Calibration:
    """Fit what can be fitted; `model` says how legs are flown, and what is not found."""
    what = Calibration(model=model)
    commands = [one for journal in journals for one in journal.commands]
    done = [one for one in commands if one.ended == DONE]
    what.commands = len(commands)
    what.broken_off = sum(one.ended == BROKEN_OFF for one in commands)
    what.failed = len(commands) - len(done) - what.broken_off
    find_durations(what, done)
    find_actions(what, [one for one in done if one.what == ACTION])
    runs = [run for journal in journals for run in journal.runs]
    find_battery(what, runs)
    find_own_actions(what, journals)
    what.bound()
    return what
