"""What does our generated code cost, beside what others would write by hand today?

`python benchmarks/flow.py` compiles `flow/app.pluto`, and lets it and the contenders do the same work
in turns, each in a process of its own: see `contenders/work.py`. What is compared is the CPU time a
trip, flights of no duration, by the least and by the median of all runs. Contenders that are not
installed are left out: `pip install -e '.[benchmarks]'` has them all.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import tempfile
from functools import partial
from pathlib import Path

from measuring.cases import FULL, SMALL, cases
from measuring.options import at_least_one
from measuring.package import compiled
from measuring.page import picture
from measuring.rounds import asked, installed, run
from measuring.table import lines, results


def tell(text: str) -> None:
    """Say how far it is."""
    print(text, file=sys.stderr, flush=True)


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description="Our generated code beside hand-written code.")
    parser.add_argument(
        "--rounds", type=at_least_one, default=7, help="each runs every contender once"
    )
    parser.add_argument("--json", action="store_true", help="print one object instead of a table")
    parser.add_argument("--write", type=Path, metavar="DIR", help="results.json and results.svg")
    parser.add_argument("--only", nargs="+", metavar="CASE", help="measure these cases only")
    parser.add_argument("--small", action="store_true", help="only see that everything works")
    given = parser.parse_args()
    size = SMALL if given.small else FULL
    names = [case.name for case in cases(size, "", "")]
    for name in given.only or ():
        if name not in names:
            parser.error(f"argument --only: there is no case {name}, only {', '.join(names)}")
    with tempfile.TemporaryDirectory() as folder:
        ours = compiled(Path(folder) / "ours")
        plain = compiled(Path(folder) / "plain", "-O0")
        known, missing = installed(cases(size, str(ours), str(plain)))
        if missing:
            tell(f"not installed, and left out: {', '.join(missing)}")
        if given.only is not None:
            known = [case for case in known if case.name in given.only]
        ask = partial(asked, patience=size.patience)
        measured = run(known, given.rounds, tell, ask)
    about = {
        "python": platform.python_version(),
        "machine": platform.machine(),
        "cpus": os.cpu_count(),
        "rounds": given.rounds,
    }
    found = results(measured, missing, about)
    if given.write is not None:
        given.write.mkdir(parents=True, exist_ok=True)
        (given.write / "results.json").write_text(json.dumps(found, indent=2) + "\n")
        (given.write / "results.svg").write_text(picture(found))
    print(json.dumps(found) if given.json else "\n".join(lines(measured)))


if __name__ == "__main__":
    main()
