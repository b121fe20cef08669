"""Put what `flow.py --write docs/benchmarks` has measured into the documentation.

`python benchmarks/page.py` draws `results.svg` anew, and writes the tables of `docs/benchmarks.md`.
"""

from __future__ import annotations

import json
from argparse import ArgumentParser
from pathlib import Path

from measuring.page import picture, rewritten

DOCS = Path(__file__).parents[1] / "docs"


def main() -> None:
    """Read what was measured, and write what is shown of it."""
    parser = ArgumentParser(description="Put into the documentation what flow.py has measured.")
    parser.parse_args()
    results = json.loads((DOCS / "benchmarks" / "results.json").read_text())
    (DOCS / "benchmarks" / "results.svg").write_text(picture(results))
    page = DOCS / "benchmarks.md"
    page.write_text(rewritten(page.read_text(), results))


if __name__ == "__main__":
    main()
