"""`python -m pluto_fleet.trials APP …`: what `plutoc test` runs of the package that it has compiled."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module


def main(name: str, words: list[str]) -> int:
    """Try the app of this package, and return the exit code."""
    from ..app import described
    from ..process.exit_code import exit_code
    from ..process.forked import refused
    from ..process.signal_guard import guard_hooks, interrupted_by_a_person
    from ..shared import output
    from ..shared.hooks.loading import loaded
    from .command import test

    def by_itself(words: list[str]) -> int:
        """Run this program with other arguments in a new process; return the exit code."""
        command = [sys.executable, "-P", "-m", "pluto_fleet.trials", name, *words]
        return subprocess.run(command, capture_output=True, check=False).returncode

    def tested() -> int:
        # a hook may raise KeyboardInterrupt or end the process, which is found then
        with interrupted_by_a_person(), refused():
            given = loaded(lambda: import_module(f"{name}.flow").APP)
            return test(described(given), words, by_itself)

    output.prepare()
    guard_hooks()
    return exit_code(name, tested)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
