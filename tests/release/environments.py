"""Fresh environments, as a user's machine would have them."""

from __future__ import annotations

import subprocess
import sys
import venv
from dataclasses import dataclass
from pathlib import Path

from tests.paths import ROOT


@dataclass(frozen=True)
class Finished:
    """A command that has ended."""

    code: int
    out: str
    err: str


def run(*command: str | Path, cwd: Path | None = None, **environment: str) -> Finished:
    """Run a command to its end; its variables are the given ones and a path to find programs."""
    import os

    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTHON", "PLUTO", "VIRTUAL_ENV"))
    }
    done = subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        env={**kept, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    return Finished(code=done.returncode, out=done.stdout, err=done.stderr)


def succeed(*command: str | Path, cwd: Path | None = None) -> str:
    """Run a command that must end with 0; return its standard output."""
    done = run(*command, cwd=cwd)
    assert done.code == 0, f"{command}: exit {done.code}\n{done.out}\n{done.err}"
    return done.out


def fresh(folder: Path) -> Path:
    """Make a fresh environment; return its folder of programs.

    Its pip is that of these tests: to install one takes longer than what a test installs by it.
    """
    venv.create(folder)
    pip = folder / "bin" / "pip"
    pip.write_text(f"#!/bin/sh\nexec '{sys.executable}' -m pip --python '{folder}' \"$@\"\n")
    pip.chmod(0o755)
    return folder / "bin"


def compile_app(source: Path, into: Path) -> Path:
    """Compile an app with the compiler under test; return the package's folder."""
    succeed(sys.executable, "-m", "plutoc", "compile", source, "-o", into, cwd=ROOT)
    return into
