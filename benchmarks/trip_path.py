"""Through how many files does a trip lead a reader? Counted as it runs, in virtual time.

`python benchmarks/trip_path.py` compiles the smallest example, simulates one mission of one trip with one
drone, and counts from the first step of the mission's flow until the event `mission.ended`, and on until
`drone.free`, when its drone is down at home. It does so twice: with the package alone, and with the
library, whose gateway keeps drones apart. All is set up before: files are read, the app and its fleet
are put together, and as this is the process's second simulation, all modules are imported.

A file is counted if one of its functions is called or goes on. A move is a call or a return by which
control goes from one file to another: a coroutine's `await` is both, one way each. Only files of the
package and the library count. What lies between two of them, such as a function of the standard library
or the `__init__` of a dataclass, is looked through.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import redirect_stdout
from importlib import import_module
from io import StringIO
from pathlib import Path
from types import FrameType

from measuring.rounds import HOME, environment

EXAMPLE = "drugs_distribution"
LIBRARY = HOME.parent / "runtime"
MISSIONS = '[[mission]]\nname = "one"\ntrip = [{ action = "take_photo", target = [3.0, 4.0] }]\n'
FLEET = '[[drone]]\nid = "cf1"\nhome = [0.5, 0.5]\n'
ENDS = ("mission.ended", "drone.free")
ALONE, WITH_LIBRARY = "alone", "with the library"


class TripPath:
    """The files that control goes through, from the first step of a flow to each of the ends."""

    def __init__(self, package: Path) -> None:
        self._flow = str(package / "flow.py")
        self._folders = (f"{package}{os.sep}", f"{LIBRARY}{os.sep}")
        self._at = ""
        """Where control is; empty: the flow has not begun."""
        self._moves = 0
        self.files: list[str] = []
        """In the order in which they were first entered."""
        self.ends: dict[str, tuple[int, int]] = {}
        """Files and moves until each of the ends."""

    def profile(self, frame: FrameType, what: str, argument: object) -> None:
        """Take note of a call or a return, as `sys.setprofile` tells of it."""
        if what == "call":
            self._go(frame)
            self._look_for_an_end(frame)
        elif what == "return":
            self._go(frame.f_back)

    def _go(self, frame: FrameType | None) -> None:
        while frame is not None and not frame.f_code.co_filename.startswith(self._folders):
            frame = frame.f_back
        if frame is None or not (self._at or frame.f_code.co_filename == self._flow):
            return
        file = frame.f_code.co_filename
        self._moves += bool(self._at) and self._at != file
        self._at = file
        if file not in self.files and len(self.ends) < len(ENDS):
            self.files.append(file)

    def _look_for_an_end(self, frame: FrameType) -> None:
        """See whether a function is told of an event that is one."""
        for told in frame.f_locals.values() if self._at else ():
            event = told.get("event") if type(told) is dict else told
            if type(event) is str and event in ENDS:
                self.ends.setdefault(event, (len(self.files), self._moves))

    @property
    def names(self) -> list[str]:
        """The files, below the folder that they are counted in."""
        package, library = self._folders
        return [file.removeprefix(package).removeprefix(library) for file in self.files]


def inside(package: Path, world: str) -> None:
    """Simulate the mission twice in this process, and print what is counted the second time."""
    sys.path[:0] = [str(package.parent), str(LIBRARY)]
    if world == ALONE:
        sys.modules["pluto_fleet"] = None  # type: ignore[assignment]  # as if it was not installed
    program: Callable[[], int] = import_module(f"{EXAMPLE}.__main__").main
    sys.argv = [EXAMPLE, "simulate", "missions.toml", "--fleet", "fleet.toml", "--json"]
    path = TripPath(package)
    for profile in (None, path.profile):
        with redirect_stdout(StringIO()) as printed:
            sys.setprofile(profile)
            code = program()
            sys.setprofile(None)
        if code:
            raise SystemExit(f"the mission was not completed:\n{printed.getvalue()}")
    print(json.dumps({"ends": path.ends, "files": path.names}))


def run(folder: Path, *command: str) -> str:
    """Run Python in a folder, and return what it prints."""
    done = subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stderr}")
    return done.stdout


def main() -> None:
    """Count in each world, and print."""
    parser = argparse.ArgumentParser(description="Through how many files a trip leads a reader.")
    parser.add_argument("--inside", nargs=2, metavar=("PACKAGE", "WORLD"), help=argparse.SUPPRESS)
    given = parser.parse_args().inside
    if given is not None:  # in a process of its own: a process has room for one brain
        inside(Path(given[0]), given[1])
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        app = HOME.parent / "examples" / EXAMPLE / "app.pluto"
        run(HOME.parent, "-m", "plutoc", "compile", str(app), "-o", str(folder / "package"))
        (folder / "missions.toml").write_text(MISSIONS)
        (folder / "fleet.toml").write_text(FLEET)
        package = folder / "package" / "src" / EXAMPLE
        for world in (ALONE, WITH_LIBRARY):
            script = str(Path(__file__).resolve())
            found = json.loads(run(folder, script, "--inside", str(package), world))
            print(f"{world}:")
            for end in ENDS:
                files, moves = found["ends"][end]
                print(f"  files {files}, moves {moves} until {end}")
            print("".join(f"    {file}\n" for file in found["files"]), end="")


if __name__ == "__main__":
    main()
