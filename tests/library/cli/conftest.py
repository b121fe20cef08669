"""Files and an app to try the command line with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import main
from tests.library.files.an_app import APP

MISSIONS = """
[[mission]]
name = "North"
[[mission.trip]]
name = "A"
action = "take_photo"
target = [2, 3]
[[mission.trip]]
action = "pollinate"
parameters = { dose = "40 mg" }
target = [4, 3]
[[mission]]
name = "South"
[[mission.trip]]
action = "measure"
target = [6, 3]
"""


@pytest.fixture
def missions(tmp_path: Path) -> Path:
    """A file of two missions that the default fleet completes."""
    path = tmp_path / "m.toml"
    path.write_text(MISSIONS)
    return path


Command = Callable[..., tuple[int, str, str]]


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Command:
    """Runs a command line, and gives exit code, standard output and standard error."""

    def run(*argv: object, app: App = APP) -> tuple[int, str, str]:
        words: Sequence[str] = [str(word) for word in argv]
        code = main(app, words)
        out, err = capsys.readouterr()
        return code, out, err

    return run
