"""`python -m APP._runtime.testing …`: what `plutoc test` runs of the package that it has compiled."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module

from plutoc_runtime.hard_exit import refused
from plutoc_runtime.raised import interrupted_by_a_person

from ..cli import Ending, output
from ..cli.loading import loaded
from .command import test


def by_itself(words: list[str]) -> int:
    """Run the same with other words, in a new process; return the exit code."""
    command = [sys.executable, "-P", "-m", __package__ or "", *words]
    return subprocess.run(command, capture_output=True, check=False).returncode


if __name__ == "__main__":
    output.prepare()
    home = (__package__ or "").partition("._runtime")[0]
    ending = Ending(home)
    with ending:
        app = loaded(lambda: import_module(f"{home}.flow").APP)
        # a hook may raise a KeyboardInterrupt, or end the process, and is found then
        with interrupted_by_a_person(), refused():
            ending.code = test(app, sys.argv[1:], by_itself)
        output.flush()
    sys.exit(ending.code)
