"""Our own contender: the package that plutoc makes of `flow/app.pluto`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from .rounds import HOME, environment


def compiled(folder: Path, *options: str) -> Path:
    """Compile the flow from the command line, and return where its package is imported from."""
    command = [sys.executable, "-m", "plutoc", "compile", str(HOME / "flow" / "app.pluto")]
    done = subprocess.run(
        [*command, "-o", str(folder), *options],
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise SystemExit(f"the flow does not compile:\n{done.stderr}")
    return folder / "src"
