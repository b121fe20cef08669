"""How much longer does it take to check 10,000 blocks than 1,000?

`python benchmarks/large_apps.py` checks apps of both sizes in several shapes, each in a process of
its own, and prints the times and their ratio. At most 12 is what we promise. `compile.py` does the
same for compiling them.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path

from measuring.options import at_least_one

HEAD = """\
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 3)
  start -> create"""
TAIL = """\
  allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  watch -> end otherwise
  retry -> end otherwise"""


def chain(size: int) -> Iterator[str]:
    """One block behind the other, all of them in a loop."""
    names = [f"wait_{i}" for i in range(size - 5)]
    yield HEAD
    yield from (f"  {name} = Clock" for name in names)
    yield f"  create -> {names[0]}"
    yield from (f"  {a} -> {b}" for a, b in pairwise(names))
    yield f"  {names[-1]} -> allocate"
    yield TAIL.replace("-> allocate", f"-> {names[0]}")


def wide(size: int) -> Iterator[str]:
    """One fork into many branches, and one gate behind them all."""
    names = [f"watch_{i}" for i in range(size - 6)]
    yield HEAD.replace("  watch = TripMonitor", "  watch = TripMonitor\n  gate = GateFunnel")
    yield from (f"  {name} = TripMonitor" for name in names)
    yield "  create -> allocate"
    yield from (f"  launch -> {name} -> gate" for name in names)
    yield TAIL.replace("watch ->", "gate ->").replace("launch -> watch", "launch -> watch -> gate")


def forks(size: int) -> Iterator[str]:
    """A loop in which a mission forks and joins again and again, and is tried once more."""
    count = (size - 1) // 7
    yield "  create = MissionCreator"
    for i in range(count):
        yield f"  allocate_{i} = DroneAllocator"
        yield f"  launch_{i} = TripLauncher"
        yield f"  watch_{i} = TripMonitor"
        yield f"  timer_{i} = TimerMonitor"
        yield f"  first_{i} = GateFIFO"
        yield f"  retry_{i} = PriorityManager(max_attempts: 3)"
        yield f"  wait_{i} = Clock"
    yield "  start -> create -> wait_0"
    for i in range(count):
        yield f"  wait_{i} -> allocate_{i} -> launch_{i} -> [watch_{i}, timer_{i}] -> first_{i}"
        yield f"  first_{i} -> wait_{(i + 1) % count} when STANDBY"
        yield f"  first_{i} -> retry_{i} when FAILED"
        yield f"  retry_{i} -> allocate_{i} when STANDBY"
        yield f"  first_{i} -> end otherwise"
        yield f"  retry_{i} -> end otherwise"


SHAPES: dict[str, Callable[[int], Iterator[str]]] = {"chain": chain, "wide": wide, "forks": forks}


def app(shape: str, size: int) -> str:
    """Return an app of that many blocks."""
    lines = "\n".join(SHAPES[shape](size))
    return f"pluto 1\n\napp {shape}_{size} {{\n{lines}\n}}\n"


def write_app(folder: Path, shape: str, size: int) -> Path:
    """Write an app of that many blocks."""
    path = folder / f"{shape}_{size}.pluto"
    path.write_text(app(shape, size))
    return path


def seconds(command: list[str]) -> float:
    """Run the compiler once, and say how long it took."""
    begun = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "plutoc", *command],
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    return time.perf_counter() - begun


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description="How the compiler's time grows with an app.")
    parser.add_argument("--sizes", type=at_least_one, nargs=2, default=(1_000, 10_000), metavar="N")
    parser.add_argument(
        "--rounds", type=at_least_one, default=3, help="each time is the least of so many"
    )
    arguments = parser.parse_args()
    print(f"{'shape':8}" + "".join(f"{n:>12,}" for n in arguments.sizes) + "   ratio")
    with tempfile.TemporaryDirectory() as folder:
        for shape in SHAPES:
            least = [
                min(
                    seconds(["check", str(write_app(Path(folder), shape, size))])
                    for _ in range(arguments.rounds)
                )
                for size in arguments.sizes
            ]
            times = "".join(f"{time:11.2f}s" for time in least)
            print(f"{shape:8}{times}{least[1] / least[0]:8.1f}", flush=True)


if __name__ == "__main__":
    main()
