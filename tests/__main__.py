"""`python -m tests --help`: every campaign, every measure, and every command that rewrites what must come out."""

from __future__ import annotations

import sys

REWRITES = {
    "pytest tests/test_cases.py --update": "what must come out of tests/cases",
    "pytest tests/compiler/emit --update": "the generated package that tests compare",
    "pytest tests/compiler/plan --update": "the plans before and after each pass",
    "pytest tests/compiler/cli/test_blocks.py --update": "the pages of the blocks",
    "pytest tests/compiler/explain --update": "the list of diagnostics",
    "pytest tests/examples/test_typed_pages.py --update": "what the tutorial, and the page on sizes, show of commands' output",
    "pytest tests/library/navigation --update": "the code that the page on navigation shows",
    "pytest tests/library/station/browser/test_every_page.py -m 'long or not long' --update": "the pictures of the ground station",
    "python -m tests.library.station.schema": "the description of the station's interface, and what is made of it",
    "pytest tests/compiler/editor/browser --update": "the pictures of the graph editor",
    "python docs/tutorial/make_pictures.py": "the pictures and the quoted files in the pages",
}
CAMPAIGNS = {
    "python -m tests.compiler.format --mutants 2000": "format many layouts of every example",
    "python -m tests.compiler.lsp.holes": "cut a thousand holes into the examples: is what stood there offered?",
    "python -m tests.fuzz --minutes 10": "feed the compiler with odd input",
    "python -m tests.soundness --random 2000": "hold the checks against an oracle; also without arguments: all mutants of the thesis's graphs",
    "python -m tests.soundness --loops 5000 --fly 50": "the same for apps full of loops, and fly those that are accepted",
    "python -m tests.mutations": "plant mistakes in the checks and the passes: each must be found",
    "python -m tests.equivalence --graphs 10000": "hold optimised packages against plain ones, some ten minutes",
    "python -m tests.trials.campaign --seeds 20": "strike all examples at every row of their journals, some ten minutes",
    "python -m tests.trials.strangers --apps 200": "try random apps in all weathers, some ten minutes",
    "python -m tests.deadlines --plans 1000": "miss no more deadlines by earliest_deadline than by nearest",
    "python -m tests.sizing --plans 100": "hold 100 promised fleets against 1,000 fresh runs each, an hour on two cores",
    "python -m tests.kill --brain 500 --gateway 100": "kill the app and its gateway in real flights, some twenty minutes",
    "python -m tests.kill.misbehaving --times 3": "let hooks misbehave in real flights under a supervisor",
    "python -m tests.flights_crazyflie.campaign": "let each fault happen to a simulated Crazyflie, some twenty minutes",
    "python -m tests.flights_crazyflie.examples": "fly every example with such Crazyflies, some ten minutes",
    "python -m tests.areas --areas 1000": "cover random areas, half a minute: is anything left out, or forbidden?",
    "python -m tests.calibrating --cases 100": "fit journals of drones whose motion is known: is it told right?",
    "python -m tests.prediction": "hold what is promised of a plan against simulated Crazyflies, some ten minutes",
    "python -m tests.prediction.phases": "what each phase of a Crazyflie's flight takes besides its trajectory, some ten minutes",
    "python -m tests.library.station.browser.every_page": "look at all of a station's pages in all sizes and languages, by day and by night, some twenty minutes; needs Chromium",
    "python -m tests.flights_crazyflie.pauses": "land and take off again, after pauses of 0 to 6 s",
}
MEASURES = {
    "python benchmarks/graph_editor.py": "how fast 300 blocks are opened, dragged and tidied in the graph editor",
    "python benchmarks/house.py": "how large the rooms are, and which import each other in a ring",
    "python benchmarks/trip_path.py": "which files one trip enters, and how often it moves between them",
    "python benchmarks/instructions.py": "a trip's instructions; --update keeps the new counts",
    "python benchmarks/flow.py": "what a trip costs beside hand-written code; pip install -e '.[benchmarks]' first",
    "python benchmarks/page.py": "write those figures into docs/benchmarks.md",
    "python benchmarks/thesis_experiment.py": "the thesis's experiment in real time",
    "python benchmarks/cold_start.py": "how long a command takes, in starts of an empty Python",
    "python benchmarks/compile.py": "how long `compile` takes: anew, after an edit, for 10,000 blocks",
    "python benchmarks/large_apps.py": "how the time of `check` grows from 1,000 blocks to 10,000",
    "python benchmarks/typing_latency.py": "from a keystroke to what is published, at 100 and 1,000 blocks",
    "python benchmarks/simulate.py": "what a trip of a simulation costs, and how that grows with drones and trips",
    "python benchmarks/allocation.py": "how long 30 plans take with each policy, beside a routing solver's plans; some ten minutes",
    "python benchmarks/choosing.py": "what it costs to choose drones, in large fleets and long queues",
    "python benchmarks/traffic.py": "how near drones come to each other, and what keeping them apart costs",
    "python benchmarks/station.py": "what it costs to watch a flight; needs Chromium",
    "python benchmarks/journal.py": "what a journal costs, and how long going on from one takes",
    "python benchmarks/crazyflie.py": "how long cflib holds up the event loop",
    "python benchmarks/invariants.py": "how many missions a second are tried",
}
SECTIONS = {
    "Rewrite, then read the diff": REWRITES,
    "Campaigns: each must find nothing": CAMPAIGNS,
    "Measures": MEASURES,
}


def listing() -> str:
    """Return all of them, a line each."""
    width = max(len(command) for commands in SECTIONS.values() for command in commands)
    parts = []
    for title, commands in SECTIONS.items():
        parts.append(f"{title}:")
        parts += [f"  {command:{width}}  {what}" for command, what in commands.items()]
        parts.append("")
    return "\n".join(["Each takes --help.", "", *parts])


if __name__ == "__main__":
    print(listing(), end="")
    sys.exit(0 if sys.argv[1:] in ([], ["--help"], ["-h"]) else 2)
