"""Plants bugs in a copy, one at a time, and prints which test catches each, and what nobody catches.

    python -m tests.planted
    python -m tests.planted --named
    python -m tests.planted --bugs 40 --room check --seed 7

A bug is one small change of the brain, of plutoc/check, plutoc/plan or the gateway; those of `named.toml` were
planted by hand, all over the product. For each the tests of the default run are tried that reach its line: first
those of its own room, last those of no room, so that a group of tests that catches a bug at the end is the only one
that does. Exits with 1 if a named bug, or more than one in ten of the others, is caught by none; those do not count
of which `left.toml` says why they are equivalent, that is, no bugs.
"""

from __future__ import annotations

import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from queue import SimpleQueue
from random import Random

from tests.kit.campaign import Campaign
from tests.paths import ROOT
from tests.planted.bug import ROOMS, Bug, left, named_bugs
from tests.planted.operators import proposals
from tests.planted.reach import distance, measured
from tests.planted.trial import Copy, Verdict

WANTED = 0.9


def main() -> int:
    """Plant what the command line asks for."""
    campaign = Campaign("tests.planted", __doc__)
    campaign.unit = "bug"
    campaign.option("--bugs", type=int, default=300, metavar="N", help="how many are drawn")
    campaign.option("--seed", type=int, default=1)
    campaign.option("--room", choices=ROOMS, help="draw from this room alone")
    campaign.option("--named", action="store_true", help="only those that were planted by hand")
    campaign.option("--seconds", type=float, default=120.0, help="tests end before that, or never")
    campaign.option("--anew", action="store_true", help="measure anew which tests reach what")
    campaign.side_by_side(2)
    options = campaign.parse()
    bugs = [] if options.room else named_bugs()
    named = len(bugs)
    if not options.named:
        bugs += drawn([options.room] if options.room else [*ROOMS], options.bugs, options.seed)
    reach = measured(options.anew)
    copies: SimpleQueue[Copy] = SimpleQueue()
    verdicts = []
    with tempfile.TemporaryDirectory(prefix="pluto-planted-") as folder:
        for number in range(options.at_once):
            copies.put(Copy(Path(folder, str(number)), reach, options.seconds))

        def tried(bug: Bug) -> Verdict:
            copy = copies.get()
            try:
                return copy.try_out(bug)
            finally:
                copies.put(copy)

        for _, verdict in campaign.each(tried, bugs, threads=True):
            print(line(verdict), flush=True)
            verdicts.append(verdict)
    by_hand, others = verdicts[:named], verdicts[named:]
    return campaign.over(*summary(by_hand, others), fails=too_few(by_hand, others))


def drawn(rooms: Sequence[str], count: int, seed: int) -> list[Bug]:
    """Draw bugs: as many from each room, and of each kind of mistake, as far as there are."""
    dice = Random(seed)
    heaps = []
    for room in rooms:
        kinds: dict[str, list[Bug]] = {}
        for place in ROOMS[room]:
            for path in sorted((ROOT / place).rglob("*.py")):
                text = path.read_text(encoding="utf-8")
                for bug in proposals(str(path.relative_to(ROOT)), text):
                    kinds.setdefault(bug.what, []).append(bug)
        for heap in kinds.values():
            dice.shuffle(heap)
        heaps.append([kinds[kind] for kind in sorted(kinds)])
    turns = [_in_turn(kinds) for kinds in heaps]
    found: list[Bug] = []
    while turns and len(found) < count:
        for turn in [*turns]:
            another = next(turn, None)
            if another is None:
                turns.remove(turn)
            elif len(found) < count:
                found.append(another)
    return found


def _in_turn(heaps: Sequence[list[Bug]]) -> Iterator[Bug]:
    """Yield one of each heap, then the next of each."""
    for number in range(max(map(len, heaps), default=0)):
        yield from (heap[number] for heap in heaps if number < len(heap))


def line(verdict: Verdict) -> str:
    """Say what came of a bug."""
    catcher = verdict.catcher or f"NOBODY of the {verdict.reached} tests that reach it"
    bug = verdict.bug
    change = f"{_short(bug.before)} -> {_short(bug.after)}"
    return f"{verdict.seconds:5.0f} s  {verdict.place}  {bug.what}: {change}\n         {catcher}"


def _short(text: str) -> str:
    one = " ".join(text.split())
    return one if len(one) <= 60 else f"{one[:57]}…"


def summary(named: Sequence[Verdict], others: Sequence[Verdict]) -> Iterator[str]:
    """Yield what all came to."""
    words = left()
    yield ""
    if named:
        caught = sum(verdict.catcher is not None for verdict in named)
        yield f"{caught} of {len(named)} that were planted by hand are caught"
    rooms = Counter(_room(verdict) for verdict in others)
    for room, count in rooms.items():
        caught = sum(v.catcher is not None for v in others if _room(v) == room)
        yield f"{caught:4} of {count:4} in {room}"
    caught = sum(verdict.catcher is not None for verdict in others)
    if others:
        yield f"{caught:4} of {len(others):4} in all ({caught / len(others):.1%})"
        seen = caught + sum(1 for _ in _missed(others))
        yield f"{caught:4} of {seen:4} that anybody could see ({caught / seen:.1%})"
    groups = Counter(_group(verdict) for verdict in (*named, *others) if verdict.catcher)
    yield "caught first by:"
    yield from (f"{count:6}  {group}" for group, count in groups.most_common())
    rest = [verdict for verdict in (*named, *others) if verdict.catcher is None]
    if rest:
        yield "caught by none:"
    for verdict in rest:
        bug = verdict.bug
        word = words.get(_key(bug))
        why = "nobody has said why" if word is None else word.why
        same = "equivalent: " if word is not None and word.equivalent else ""
        yield f"  {verdict.place}: {_short(bug.before)} -> {_short(bug.after)}: {same}{why}"


def too_few(named: Sequence[Verdict], others: Sequence[Verdict]) -> Iterator[str]:
    """Yield why too few are caught."""
    if not all(verdict.catcher for verdict in named):
        yield "some that were planted by hand are not caught"
    caught, missed = sum(verdict.catcher is not None for verdict in others), sum(
        1 for _ in _missed(others)
    )
    if caught < WANTED * (caught + missed):
        yield f"less than {WANTED:.0%} of the others that anybody could see are caught"


def _missed(verdicts: Sequence[Verdict]) -> Iterator[Verdict]:
    """Yield those that nobody catches, but for those of which is known that they change nothing."""
    words = left()
    for verdict in verdicts:
        word = words.get(_key(verdict.bug))
        if verdict.catcher is None and (word is None or not word.equivalent):
            yield verdict


def _key(bug: Bug) -> tuple[str, str, str, str]:
    return bug.key((ROOT / bug.file).read_text(encoding="utf-8"))


def _room(verdict: Verdict) -> str:
    file = verdict.bug.file
    return next(room for room, places in ROOMS.items() if file.startswith(places))


def _group(verdict: Verdict) -> str:
    """Return the folder of the test that caught it, and how far that is from the bug."""
    assert verdict.catcher
    far = ("beside it", "in its part", "in another part", "in no room")
    if not verdict.catcher.startswith("tests/"):
        return verdict.catcher
    folder = verdict.catcher.split("::")[0].rpartition("/")[0]
    return f"{folder} ({far[distance(verdict.bug.file, verdict.catcher)]})"


if __name__ == "__main__":
    sys.exit(main())
