"""What came of many apps, counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from tests.soundness.compare import Compared
from tests.soundness.state import Verdict

UNJUDGED, SOUND, UNSOUND = "unjudged", "sound", "unsound"
UNSEEN = "unseen"
"""Refused only for what no run can show."""
COLUMNS = ("apps", UNJUDGED, SOUND, UNSOUND, *map(str, Verdict), UNSEEN, "doubtful", "disagree")


@dataclass(slots=True, kw_only=True)
class Tally:
    """Counts of one graph's mutants, or of many graphs'."""

    counts: Counter[str] = field(default_factory=Counter)
    """By column; one app can show several verdicts."""
    codes: Counter[str] = field(default_factory=Counter)
    pairs: Counter[tuple[str, str]] = field(default_factory=Counter)
    """What the oracle saw, and what the compiler said of the same app."""

    def add(self, compared: Compared) -> None:
        """Count an app."""
        judgement, counts = compared.judgement, self.counts
        counts["apps"] += 1
        if judgement is None:
            counts[UNJUDGED] += 1
            return
        self.codes.update(compared.codes)
        counts["states"] += judgement.states
        counts["disagree"] += not compared.agrees
        if judgement.doubtful:
            counts["doubtful"] += 1
        elif judgement.sound:
            counts[SOUND] += 1
            counts[UNSEEN] += bool(compared.codes)
        else:
            counts[UNSOUND] += 1
            seen = [str(verdict) for verdict in judgement.runs]
            counts.update(seen)
            self.pairs.update((s, code) for s in seen or ["faults"] for code in compared.codes)


def lines(tallies: Mapping[str, Tally]) -> Iterator[str]:
    """Yield the tables, ready to be printed."""
    whole = Tally()
    for tally in tallies.values():
        whole.counts += tally.counts
        whole.pairs += tally.pairs
    first = max(map(len, tallies), default=0)
    yield "  ".join([" " * first, *COLUMNS])
    for name, tally in {**tallies, "all": whole}.items():
        cells = (str(tally.counts[column]).rjust(len(column)) for column in COLUMNS)
        yield "  ".join([name.ljust(first), *cells])
    yield "what the oracle saw, and the codes of the same apps:"
    for seen in (*map(str, Verdict), "faults"):
        found = [(n, code) for (verdict, code), n in whole.pairs.items() if verdict == seen]
        if found:
            yield f"  {seen}: {', '.join(f'{code} {n}' for n, code in sorted(found, reverse=True))}"
    yield f"states explored: {whole.counts['states']}"
