"""Keeps a journal as this version writes it, for all later ones to go on from.

`python -m tests.library.journal.keeping` flies `golden/source` with mishaps, stops it in the middle, and puts
its journal into `golden/LANGUAGE-VERSION-EVENTS`, with the app as it was and what the journal comes to.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path

from pluto_fleet.journal.fold import replayed
from pluto_fleet.journal.header import EVENTS, LANGUAGE
from pluto_fleet.journal.store import Store
from plutoc import __version__
from tests.kit.apps import compiled_file

GOLDEN = Path(__file__).parent / "golden"
SOURCE = GOLDEN / "source"
APP, JOURNAL, RECORDS = "farm", "flight.journal", "records.json"
LAST = "North: goes on with more trips (new: second look)"
"""Then it is stopped: delays are waited for, trips fly, some have failed and one is new."""

FLY = ("--sim", "--speed", "20", "--fail", "action=25%", "--seed", "3")


def run(package: Path, *words: object) -> subprocess.Popen[str]:
    """Run a command of a package."""
    command = [sys.executable, "-m", APP, *map(str, words)]
    return subprocess.Popen(command, cwd=package / "src", stdout=subprocess.PIPE, text=True)


def said(package: Path, *words: object) -> tuple[int, Sequence[str]]:
    """Run a command to its end, and return its exit code and what it printed."""
    process = run(package, *words)
    out, _ = process.communicate()
    return process.returncode, out.splitlines()


def records_of(journal: Path) -> object:
    """Return what a journal comes to, as plain data."""
    store = Store.open(journal)
    read = store.read()
    records = replayed(read)
    store.close()
    if read.damaged or store.torn:
        raise AssertionError(f"{journal}: {read.damaged or store.torn}")
    return json.loads(json.dumps(records.data))


def written(records: object) -> str:
    """Return records as a person reads a change of them."""
    return json.dumps(records, indent=1) + "\n"


def main() -> None:
    """Fly, stop, and keep."""
    kept = GOLDEN / f"{LANGUAGE}-{__version__}-{EVENTS}"
    with tempfile.TemporaryDirectory() as name:
        package = compiled_file(SOURCE / "app.pluto", Path(name) / APP)
        journal = Path(name) / JOURNAL
        plan = (SOURCE / "missions.toml", "--fleet", SOURCE / "fleet.toml")
        flight = run(package, "fly", *plan, *FLY, "--journal", journal)
        assert flight.stdout is not None
        for line in flight.stdout:
            if line.rstrip().endswith(LAST):
                break
        print(*said(package, "tell", journal, "stop", "--rtl")[1], sep="\n")
        flight.communicate()
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(SOURCE, kept)
        shutil.copyfile(journal, kept / JOURNAL)
        (kept / RECORDS).write_text(written(records_of(journal)))
    print(f"kept in {kept}")


if __name__ == "__main__":
    ArgumentParser(prog="python -m tests.library.journal.keeping", description=__doc__).parse_args()
    main()
