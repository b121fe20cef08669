"""What a flown plan means for whoever asked: the exit code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from plutoc_runtime.domain.status import Status

if TYPE_CHECKING:
    from plutoc_runtime.alone.simulate import Outcome

_NEEDS_A_PERSON = (Status.UNCERTAIN, Status.HELD)
_BAD = (Status.FAILED, Status.CANCELLED)


def exit_code(outcome: Outcome) -> int:
    """Return 0, 1 if a mission failed or the simulation was given up, or 4 if one waits for a person.

    A mission that `--until` cut short has not failed.
    """
    code = code_of([mission.status for mission in outcome.missions])
    return 1 if outcome.given_up and not code else code


def code_of(statuses: Sequence[Status]) -> int:
    """Return the exit code for missions that stand so."""
    if any(status in _NEEDS_A_PERSON for status in statuses):
        return 4
    return 1 if any(status in _BAD for status in statuses) else 0
