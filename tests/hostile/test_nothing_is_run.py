"""No code of a user's is run. That of ours runs no texts as code is seen by ruff."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.kit import command as commands


def test_hooks_are_read_and_never_run(app: Path) -> None:
    """By no command that does not fly."""
    trap = Path("hacked")
    Path("hooks.py").write_text(
        f"open({str(trap)!r}, 'w').close()\n"
        "def pollinate(drone, trip, context, *, dose): ...\n"
        "def find_blooms(mission, results): ...\n"
    )
    for command in (["check"], ["compile"], ["compile", "--add-stubs"], ["graph"]):
        assert commands.plutoc(*command, app).code == 0, command
    assert not trap.exists()


@pytest.mark.process
def test_the_folder_that_we_are_in_is_no_place_for_modules(app: Path) -> None:
    """A stranger's folder may hold a json.py, a lark.py or a plutoc_blocks.py beside the app."""
    for name in ("json", "lark", "ast", "black", "plutoc_blocks", "sitecustomize", "jinja2"):
        Path(f"{name}.py").write_text("open('hacked', 'w').close()\n")
    paths = [path for path in sys.path if path and Path(path).is_dir()]
    start = f"import sys; sys.path[:] = {paths!r}; from plutoc.cli import main; sys.exit(main())"
    done = subprocess.run(
        [sys.executable, "-P", "-c", start, "compile", app],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not Path("hacked").exists()
