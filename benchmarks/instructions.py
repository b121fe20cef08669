"""How many instructions does a trip cost? A figure that no busy machine disturbs.

`python benchmarks/instructions.py` lets valgrind count what our package executes for less work and
for more: the difference is of trips alone. It ends with 1 if a trip costs more than `instructions.json`
says, by more than the tolerance. `--update` counts the contenders too and writes that file. Counts are
those of one build of Python: with another, or without valgrind, it says so and compares nothing.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from contenders.work import Work
from measuring.cases import arguments
from measuring.package import compiled
from measuring.rounds import HOME, Case, asked, environment

BASELINE = HOME / "instructions.json"
TOLERANCE = 0.03
"""What a trip of ours may cost more than it did: what machines differ in, and no more."""
FEW, MANY = (Work(missions=missions, drones=20) for missions in (40, 240))
VALGRIND = ("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null")


BARE = (Case(name="ideal", module="ideal"), Case(name="generators", module="generators"))
"""What ours is held against."""


def ours(package: Path) -> tuple[Case, ...]:
    """Return what is counted every time, with all that it needs but the work."""
    given = ("--package", str(package))
    return (
        Case(name="ours", module="ours", arguments=given),
        Case(name="ours_virtual", module="ours", arguments=(*given, "--virtual")),
    )


def counted(case: Case, work: Work) -> tuple[int, int]:
    """Return the instructions of a whole process, and its flights."""
    command = [*VALGRIND, *case.command, "--unchecked", *arguments(work)]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True, check=False)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or collected is None:
        raise SystemExit(f"{case.name} failed:\n{done.stderr}")
    return int(collected[1]), int(json.loads(done.stdout.splitlines()[-1])["flights"])


def a_trip(case: Case) -> int:
    """Return the instructions of one more trip."""
    asked(case)  # its bytecode is kept from now on
    few, many = counted(case, FEW), counted(case, MANY)
    return round((many[0] - few[0]) / (many[1] - few[1]))


def counts(bare: Sequence[Case]) -> dict[str, int]:
    """Return the instructions a trip of ours and of these, two counted at a time."""
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        known = (*bare, *ours(compiled(Path(folder))))
        return dict(zip([case.name for case in known], pool.map(a_trip, known), strict=True))


def compared(now: Mapping[str, int], before: Mapping[str, int]) -> Iterator[str]:
    """Give what a trip of ours costs too much."""
    for name, count in now.items():
        if count > before[name] * (1 + TOLERANCE):
            yield (
                f"{name}: {count:,} instructions a trip, {count / before[name] - 1:.1%} more than "
                f"the {before[name]:,} of {BASELINE.name}; if that is worth it, use --update"
            )


def why_not() -> str | None:
    """Say why nothing can be compared here; None: it can."""
    if shutil.which("valgrind") is None:
        return "valgrind is not installed"
    if not BASELINE.exists():
        return f"{BASELINE.name} is missing: --update writes it"
    known = json.loads(BASELINE.read_text())["python"]
    return None if known == sys.version else f"{BASELINE.name} is of Python {known}"


def main() -> int:
    """Count, print, compare."""
    parser = argparse.ArgumentParser(description="How many instructions a trip costs.")
    parser.add_argument("--update", action="store_true", help="write what is counted")
    update, reason = parser.parse_args().update, why_not()
    if reason is not None and not update:
        print(f"nothing is compared: {reason}")
        return 0
    now = counts(BARE if update else ())
    if update:
        BASELINE.write_text(json.dumps({"python": sys.version, "a_trip": now}, indent=2) + "\n")
    before: dict[str, int] = json.loads(BASELINE.read_text())["a_trip"]
    for name, count in now.items():
        print(f"{name:14}{count:9,} instructions a trip, {before[name]:,} before")
    for name, bare in (("ours", "ideal"), ("ours_virtual", "generators")):
        print(f"{name} / {bare}: {now[name] / before[bare]:.3f}")
    dearer = list(compared(now, before))
    print("\n".join(dearer) or "no dearer than before")
    return 1 if dearer else 0


if __name__ == "__main__":
    raise SystemExit(main())
