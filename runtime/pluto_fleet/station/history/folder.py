"""Where flights of the past are kept: journals with their recordings, and rehearsals."""

from __future__ import annotations

from pathlib import Path

from ...journal.place import ENDING, beside
from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, quoted
from .recording import SUFFIX

_LONGEST_NAME = 80


def recording_of(journal: Path) -> Path:
    """Return the path of the recording of a flight."""
    return beside(journal, SUFFIX)


def rehearsals_in(own_folder: Path) -> Path:
    """Return the folder of recordings that are of no flight: `<id>.recording` each."""
    return own_folder / "rehearsals"


def journals_in(folder: Path) -> dict[str, Path]:
    """Return the journals in a folder by the ids of their flights."""
    return {path.name.removesuffix(ENDING): path for path in folder.glob(f"*{ENDING}")}


def found(folder: Path, id: str) -> Path:
    """Return the journal of a flight; raise `BadInput` if there is none of this id.

    An id is looked up in what the folder holds, and never made into a path.
    """
    try:
        return journals_in(folder)[id]
    except KeyError:
        raise BadInput(f"there is no flight {quoted(cut_off(id, _LONGEST_NAME))} here") from None


def rehearsal(own_folder: Path, id: str) -> Path | None:
    """Return the recording of a rehearsal, or None."""
    there = rehearsals_in(own_folder).glob(f"*{SUFFIX}")
    return {path.name.removesuffix(SUFFIX): path for path in there}.get(id)
