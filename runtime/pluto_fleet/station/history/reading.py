"""Reading the journals of flights, also of those that other processes write, and rehearsals."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...journal import errors
from ...journal.database import Instant
from ...journal.errors import JournalError
from ...journal.facts import check, events_of
from ...journal.place import ENDING
from ...journal.reader import Reader, standing_of
from ...journal.standing import Standing
from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, quoted

Event = dict[str, Any]

REHEARSAL = ".rehearsal"
"""The end of a rehearsal's name: each of its lines is the events of an instant, as a journal has them."""

_LONGEST_NAME = 80


@dataclass(slots=True)
class JournalText:
    """A journal that is read from its beginning."""

    path: Path
    damaged: str = ""
    """What is wrong with it, after all that can be read; empty: nothing."""

    def instants(self) -> Iterator[tuple[Instant, list[Event]]]:
        """Yield its instants and their events, the header first, as far as they are as they must be."""
        try:
            reader = Reader(self.path)
        except JournalError as error:
            self.damaged = str(error)
            return
        with closing(reader):
            for instant in reader.instants():
                try:
                    events = instant.events
                    for event in events:
                        check(event)
                except ValueError as error:
                    self.damaged = f"{self.path}: {errors.unfit(instant.seq, error)}"
                    return
                if events:
                    yield instant, events
            if reader.damaged is not None:
                self.damaged = str(errors.damaged(self.path, reader.damaged))

    def standing(self) -> Standing:
        """Return where everything stands; nothing of a journal whose rows cannot be read."""
        try:
            return standing_of(self.path)
        except JournalError as error:
            self.damaged = self.damaged or str(error)
            return Standing()


class RehearsalText(JournalText):
    """A rehearsal, which this station has written."""

    def instants(self) -> Iterator[tuple[Instant, list[Event]]]:
        """Yield its instants and their events."""
        with self.path.open(encoding="utf-8") as file:
            for number, line in enumerate(file):
                yield Instant(number, 0.0, line, 0), events_of(line)


def rehearsals_in(own_folder: Path) -> Path:
    """Return the folder of rehearsals: `<id>.rehearsal` each."""
    return own_folder / "rehearsals"


def rehearsal(own_folder: Path, id: str) -> RehearsalText | None:
    """Return a rehearsal, or None."""
    for path in rehearsals_in(own_folder).glob(f"*{REHEARSAL}"):
        if path.stem == id:
            return RehearsalText(path)
    return None


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
