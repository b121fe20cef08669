"""`python -m tests`: every campaign, every measure, and every command that rewrites what must come out.

What a campaign and a measure are for is the first line of their docstring.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.paths import ROOT

REWRITES = {
    "pytest tests/test_cases.py --update": "what must come out of tests/cases",
    "pytest tests/compiler/emit --update": "the generated package that tests compare",
    "pytest tests/compiler/plan --update": "the plans before and after each pass; so in all rooms with cases in text files",
    "pytest tests/compiler/cli/test_blocks.py --update": "the pages of the blocks",
    "pytest tests/compiler/explain --update": "the list of diagnostics",
    "pytest tests/examples/test_typed_pages.py --update": "what the tutorial, and the page on sizes, show of commands' output",
    "pytest tests/library/drones --update": "the code that the page on navigation shows",
    "pytest tests/library/station/browser/test_every_page.py -m 'long or not long' --update": "the pictures of the ground station",
    "python -m station_interface": "the description of the station's interface, and what is made of it",
    "pytest tests/compiler/editor/browser --update": "the pictures of the graph editor",
    "python docs/tutorial/make_pictures.py": "the pictures and the quoted files in the pages",
}
CAMPAIGNS = (
    "python -m tests.format --mutants 2000",
    "python -m tests.lsp",
    "python -m tests.service",
    "python -m tests.generated",
    "python -m tests.fuzz --minutes 10",
    "python -m tests.forged --files 2000",
    "python -m tests.forged.floods",
    "python -m tests.soundness --random 2000",
    "python -m tests.soundness --loops 5000 --fly 50",
    "python -m tests.hooks --apps 5000",
    "python -m tests.mutations",
    "python -m tests.equivalence --graphs 10000",
    "python -m tests.trials.campaign --seeds 20",
    "python -m tests.trials.strangers --apps 200",
    "python -m tests.deadlines --plans 1000",
    "python -m tests.hours --each 200 --real",
    "python -m tests.sizing --plans 100",
    "python -m tests.kill --brain 500 --gateway 100",
    "python -m tests.flights_crazyflie.campaign",
    "python -m tests.flights_mavlink.campaign --times 3",
    "python -m tests.flights_mavlink.campaign --seeds 20",
    "python -m tests.flights_mavlink.kills --brain 45 --gateway 15",
    "python -m tests.flights_crazyflie.examples",
    "python -m tests.flights_mavlink.examples --times 10",
    "python -m tests.waits --flights 6 --load 8",
    "python -m tests.waits --flights 6 --crtp --load 8 --stall 4",
    "python -m tests.areas --areas 1000",
    "python -m tests.geodesy --places 10000",
    "python -m tests.batteries --apps 400",
    "python -m tests.calibrating --cases 100",
    "python -m tests.prediction",
    "python -m tests.prediction.phases",
    "python -m tests.prediction.heights",
    "python -m tests.pages",
    "python -m tests.planted",
)
MEASURES = (
    "python benchmarks/graph_editor.py",
    "python benchmarks/house.py",
    "python benchmarks/trip_path.py",
    "python benchmarks/instructions.py",
    "python benchmarks/flow.py",
    "python benchmarks/page.py",
    "python benchmarks/thesis_experiment.py",
    "python benchmarks/cold_start.py",
    "python benchmarks/compile.py",
    "python benchmarks/large_apps.py",
    "python benchmarks/typing_latency.py",
    "python benchmarks/simulate.py",
    "python benchmarks/allocation.py",
    "python benchmarks/choosing.py",
    "python benchmarks/traffic.py",
    "python benchmarks/station.py",
    "python benchmarks/large_plan.py",
    "python benchmarks/journal.py",
    "python benchmarks/crazyflie.py",
    "python benchmarks/many_vehicles.py",
    "python benchmarks/invariants.py",
    "python benchmarks/following.py",
    "python benchmarks/sent_on.py",
    "python benchmarks/pursuit.py",
    "python benchmarks/event_latency.py",
    "python benchmarks/pursuit_real_time.py",
    "python benchmarks/survey.py",
)


def file_of(command: str) -> Path:
    """Return what a command of Python's runs, or what pytest is asked to test."""
    target = next(word for word in command.split()[1:] if word != "-m")
    if not command.startswith("python -m"):
        return ROOT / target
    within = ROOT if target.startswith("tests.") else ROOT / "runtime"
    place = within / target.replace(".", "/")
    return place / "__main__.py" if place.is_dir() else place.with_suffix(".py")


def purpose(command: str) -> str:
    """Return the first line of the docstring of what a command runs."""
    tree = ast.parse(file_of(command).read_text(encoding="utf-8"))
    return (ast.get_docstring(tree) or "").partition("\n")[0]


def listing() -> Iterator[str]:
    """Yield the lines of all of them."""
    yield "Each takes --help."
    for title, commands in (
        ("Rewrite, then read the diff", REWRITES),
        ("Campaigns: each must find nothing", dict.fromkeys(CAMPAIGNS)),
        ("Measures", dict.fromkeys(MEASURES)),
    ):
        yield f"\n{title}:"
        for command, what in commands.items():
            yield f"  {command:50}  {what or purpose(command)}"


if __name__ == "__main__":
    print("\n".join(listing()))
    sys.exit(0 if sys.argv[1:] in ([], ["--help"], ["-h"]) else 2)
