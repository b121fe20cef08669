"""What came of many apps, counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from tests.soundness.compare import Compared
from tests.soundness.state import Verdict


@dataclass(slots=True, kw_only=True)
class Tally:
    """Counts of one graph's mutants, or of many graphs'."""

    apps: int = 0
    unjudged: int = 0
    """Refused before their graph is looked at."""
    sound: int = 0
    unsound: int = 0
    doubtful: int = 0
    verdicts: Counter[Verdict] = field(default_factory=Counter)
    """By what a run shows; one app can show several."""
    unseen: int = 0
    """Refused only for what no run can show."""
    codes: Counter[str] = field(default_factory=Counter)
    pairs: Counter[tuple[str, str]] = field(default_factory=Counter)
    """What the oracle saw, and what the compiler said of the same app."""
    states: int = 0
    disagreements: int = 0

    def add(self, compared: Compared) -> None:
        """Count an app."""
        self.apps += 1
        judgement = compared.judgement
        if judgement is None:
            self.unjudged += 1
            return
        self.codes.update(compared.codes)
        self.states += judgement.states
        self.disagreements += not compared.agrees
        if judgement.doubtful:
            self.doubtful += 1
            return
        if judgement.sound:
            self.sound += 1
            self.unseen += bool(compared.codes)
            return
        self.unsound += 1
        self.verdicts.update(judgement.runs.keys())
        seen = [str(verdict) for verdict in judgement.runs] or ["faults"]
        self.pairs.update((verdict, code) for verdict in seen for code in compared.codes)

    @property
    def row(self) -> tuple[int, ...]:
        """A line of the table."""
        shown = (self.verdicts[verdict] for verdict in Verdict)
        ends = (self.unseen, self.doubtful, self.disagreements)
        return (self.apps, self.unjudged, self.sound, self.unsound, *shown, *ends)


HEADER = (
    "graph",
    "mutants",
    "unjudged",
    "sound",
    "unsound",
    *(str(verdict) for verdict in Verdict),
    "unseen",
    "doubtful",
    "disagree",
)


def total(tallies: Iterable[Tally]) -> Tally:
    """Return the sum."""
    summed = Tally()
    for tally in tallies:
        summed.apps += tally.apps
        summed.unjudged += tally.unjudged
        summed.sound += tally.sound
        summed.unsound += tally.unsound
        summed.doubtful += tally.doubtful
        summed.unseen += tally.unseen
        summed.states += tally.states
        summed.disagreements += tally.disagreements
        summed.verdicts.update(tally.verdicts)
        summed.codes.update(tally.codes)
        summed.pairs.update(tally.pairs)
    return summed


def lines(tallies: Mapping[str, Tally]) -> Iterator[str]:
    """Yield the tables, ready to be printed."""
    rows = [(name, *map(str, tally.row)) for name, tally in tallies.items()]
    whole = total(tallies.values())
    rows.append(("all", *map(str, whole.row)))
    first = max(len(row[0]) for row in rows)
    for row in (HEADER, *rows):
        cells = zip(row[1:], HEADER[1:], strict=True)
        yield "  ".join([row[0].ljust(first), *(cell.rjust(len(head)) for cell, head in cells)])
    yield ""
    yield "what the oracle saw, and the codes of the same apps:"
    for seen in (*(str(verdict) for verdict in Verdict), "faults"):
        found = [(n, code) for (verdict, code), n in whole.pairs.items() if verdict == seen]
        if found:
            told = ", ".join(f"{code} {n}" for n, code in sorted(found, reverse=True))
            yield f"  {seen}: {told}"
    yield f"states explored: {whole.states}"
