"""An app whose hooks cannot be loaded says so, with the place, and without a traceback."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from importlib import import_module, invalidate_caches
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import start
from pluto_fleet.shared.domain.app import SEAM


@pytest.fixture
def load_with(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str], int]]:
    """Start an app whose hooks.py holds this text."""
    monkeypatch.syspath_prepend(str(tmp_path))
    folder = tmp_path / "tried"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "flow.py").write_text("from . import hooks\nAPP = hooks.judge\n")

    def start_it(text: str) -> int:
        (folder / "hooks.py").write_text(text)
        invalidate_caches()
        return start("tried", load, "tried", SEAM)

    def load() -> App:
        app: App = import_module("tried.flow").APP
        return app

    yield start_it
    for name in [name for name in sys.modules if name.partition(".")[0] == "tried"]:
        del sys.modules[name]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("import no_such_module\n", "hooks.py:1: the hooks cannot be loaded: ModuleNotFoundError"),
        ("def judge():\n  return 1 +\n", "hooks.py:2: invalid syntax"),
        ("raise SystemExit(0)\n", "hooks.py:1: the hooks cannot be loaded: SystemExit: 0"),
        ("raise GeneratorExit\n", "hooks.py:1: the hooks cannot be loaded: GeneratorExit"),
        ("raise KeyboardInterrupt\n", "hooks.py:1: the hooks cannot be loaded: KeyboardInterrupt"),
        (
            "import os\nos._exit(0)\n",
            "hooks.py:2: the hooks cannot be loaded: SystemExit: os._exit(0)",
        ),
        ("\n\nundefined\n", "hooks.py:3: the hooks cannot be loaded: NameError"),
        ("def judges():\n  pass\n", "hooks.py has no judge: write it"),
    ],
)
def test_what_is_wrong_with_the_hooks_is_told_with_its_place(
    text: str, said: str, load_with: Callable[[str], int], capsys: pytest.CaptureFixture[str]
) -> None:
    assert load_with(text) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert "Traceback" not in printed.err


def test_what_hooks_end_with_is_told_in_a_line_of_some_length(
    load_with: Callable[[str], int], capsys: pytest.CaptureFixture[str]
) -> None:
    """And nothing in it commands a terminal."""
    assert load_with("raise ValueError('\\x1b[2J' * 1_000_000)\n") == 2
    told = capsys.readouterr().err
    assert len(told) < 5_000 and "\x1b" not in told


@pytest.mark.long
@pytest.mark.process
def test_a_process_that_hooks_fork_as_they_are_loaded_is_no_app(
    load_with: Callable[[str], int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORKED", "")
    forks = "pid = os.fork()\nif pid:\n  os.environ['FORKED'] = str(pid)\n  raise ValueError\n"
    assert load_with(f"import os\ndef judge():\n  pass\n{forks}") == 2
    _, status = os.waitpid(int(os.environ["FORKED"]), 0)
    assert os.waitstatus_to_exitcode(status) == 0


@pytest.mark.parametrize("command", ["tell", "journal", "decide"])
def test_an_app_can_be_stopped_with_anything_in_its_hooks(
    command: str,
    load_with: Callable[[str], int],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """And its journal can be read: only who asks for missions needs them."""
    what = ["stop"] if command == "tell" else []
    monkeypatch.setattr(sys, "argv", ["tried", command, "no.journal", *what])
    assert load_with("import no_such_module\n") == 2
    no_journal = "no.journal: there is no such journal" in capsys.readouterr().err
    assert no_journal is (command != "decide")
