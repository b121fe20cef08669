"""How many instructions does a trip cost? A figure that no busy machine disturbs.

`python benchmarks/instructions.py` has valgrind count what our package executes to fly. It ends with 1
if a trip costs more than `instructions.json` says, by more than the tolerance. `--update` counts the
yardsticks too, and writes that file. Counts are those of one build of Python: with another, or without
valgrind, it says so and compares nothing.
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

from contenders.process import Said
from contenders.work import Work
from measuring.cases import arguments
from measuring.package import compiled
from measuring.rounds import HOME, Case, asked, environment

BASELINE = HOME / "instructions.json"
TOLERANCE = 0.03
"""What a trip of ours may cost more than it did: what machines differ in, and no more."""
WORK = Work(missions=200, drones=20)
VALGRIND = ("valgrind", "--tool=callgrind", "--dump-before=getppid")
"""It writes down its count, and begins anew, where a contender makes its mark."""
RUNS = 2
"""The first run warms up, as Python does; the last one counts."""

BARE = (Case(name="ideal", module="ideal"), Case(name="generators", module="generators"))
"""What ours is held against."""


def ours(package: Path) -> tuple[Case, ...]:
    """Return what is counted every time, with all that it needs but the work."""
    given = ("--package", str(package))
    return (
        Case(name="ours", module="ours", arguments=given),
        Case(name="ours_virtual", module="ours", arguments=(*given, "--virtual")),
    )


def a_trip(case: Case) -> int:
    """Return the instructions of one trip."""
    asked(case)  # its bytecode is kept from now on
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "count"
        command = [*VALGRIND, f"--callgrind-out-file={out}", *case.command]
        done = subprocess.run(
            [*command, *arguments(WORK), "--repeat", str(RUNS)],
            env=environment(),
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise SystemExit(f"{case.name} failed:\n{done.stderr}")
        last = out.with_name(f"count.{2 * RUNS}")  # between the marks before and after the last run
        (total,) = re.findall(r"^totals: (\d+)", last.read_text(), re.MULTILINE)
    said: Said = json.loads(done.stdout.splitlines()[-1])
    return round(int(total) / said["flights"])


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
    if update and shutil.which("valgrind") is None:
        parser.error(f"nothing can be counted: {reason}")
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
