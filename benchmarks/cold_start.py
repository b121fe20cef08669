"""How long does one wait for `plutoc`, measured in starts of an empty Python?

`python benchmarks/cold_start.py` runs each command in turn with `python -c pass`, round after round,
and prints for each the least and the median time, both as ratios to those of the empty Python, and
which of the costly modules it imported.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from statistics import median

from measuring.options import at_least_one

COSTLY = ("lark", "argparse", "importlib.metadata", "networkx", "jinja2", "black", "asyncio")

SOUND = """\
pluto 1

app sound {
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator(policy: nearest)
  launch = TripLauncher
  watch = TripMonitor
  timer = TimerMonitor(default: 5 min)
  first = GateFIFO
  again = MissionRepeater
  retry = PriorityManager(max_attempts: 3)
  judge = MissionEvaluator(hook: find_blooms)
  evaluator find_blooms

  start -> create -> wait -> allocate -> launch -> [watch, timer] -> first
  first -> allocate when STANDBY
  first -> retry when FAILED
  first -> judge when COMPLETED
  retry -> allocate when STANDBY
  judge -> allocate when STANDBY
  judge -> again when COMPLETED
  again -> allocate when STANDBY
  again -> end when COMPLETED
  judge -> end otherwise
  retry -> end otherwise
}
"""
"""Ten blocks."""
WARNED = SOUND.replace("max_attempts: 3", "max_attempts: 0").replace(
    "  retry -> end otherwise\n", ""
)
"""A trip that always fails is flown for ever: the warning shows how it goes round."""
HOOKS = """\
from plutoc_runtime.domain.model import Mission
from plutoc_runtime.domain.model import Results
from plutoc_runtime.hooks.context import Verdict


def find_blooms(mission: Mission, results: Results) -> Verdict:
    return Verdict()
"""


def commands(folder: Path) -> dict[str, list[str]]:
    """Write the apps, and return what is measured."""
    for name, text in {"sound": SOUND, "warned": WARNED, "hooked": SOUND}.items():
        (folder / name).mkdir()
        (folder / name / "app.pluto").write_text(text)
    (folder / "hooked" / "hooks.py").write_text(HOOKS)
    return {
        "--version": ["--version"],
        "--help": ["--help"],
        "check": ["check", str(folder / "sound" / "app.pluto")],
        "check, with a hooks.py": ["check", str(folder / "hooked" / "app.pluto")],
        "check, with a warning": ["check", str(folder / "warned" / "app.pluto")],
    }


def program() -> list[str]:
    """Return how plutoc is called: as it is installed beside this Python, if it is."""
    installed = Path(sys.executable).with_name("plutoc")
    return [str(installed)] if installed.is_file() else [sys.executable, "-m", "plutoc"]


def measured(calls: Mapping[str, list[str]], rounds: int) -> dict[str, list[float]]:
    """Return how long each call took, in seconds; one of each a round."""
    took: dict[str, list[float]] = {name: [] for name in calls}
    # what is installed has its bytecode beside it: measure that, not how long Python compiles
    unwanted = ("PYTHONDONTWRITEBYTECODE", "PYTHONPROFILEIMPORTTIME")
    environment = {name: value for name, value in os.environ.items() if name not in unwanted}
    for number in range(rounds + 1):
        for name, call in calls.items():
            begun = time.perf_counter()
            subprocess.run(call, check=True, capture_output=True, env=environment)
            if number:  # the first round fills caches: bytecode
                took[name].append(time.perf_counter() - begun)
    return took


def imported(arguments: list[str]) -> list[str]:
    """Return the costly modules that a command loads."""
    code = (
        "import sys; from plutoc.cli import main; main(sys.argv[1:]);"
        f"print(*[name for name in {COSTLY} if name in sys.modules])"
    )
    call = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(call, check=True, capture_output=True, text=True)
    return done.stdout.splitlines()[-1].split()


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description="How long one waits for plutoc.")
    parser.add_argument(
        "--rounds", type=at_least_one, default=20, help="each runs every command once"
    )
    rounds = parser.parse_args().rounds
    with tempfile.TemporaryDirectory() as folder:
        asked = commands(Path(folder))
        calls = {name: [*program(), *arguments] for name, arguments in asked.items()}
        took = measured({"python -c pass": [sys.executable, "-c", "pass"], **calls}, rounds)
        modules = {name: imported(arguments) for name, arguments in asked.items()}
    empty = took["python -c pass"]
    print(f"{'':24}{'least':>8}{'ratio':>7}{'median':>9}{'ratio':>7}  imports")
    for name, times in took.items():
        least, middle = min(times), median(times)
        print(
            f"{name:24}{least * 1000:5.0f} ms{least / min(empty):7.1f}"
            f"{middle * 1000:6.0f} ms{middle / median(empty):7.1f}"
            f"  {', '.join(modules.get(name, []))}"
        )


if __name__ == "__main__":
    main()
