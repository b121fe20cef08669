"""The page about the seam says what is so: its example runs, and it names all that there is."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.flow.control import _COMMANDS
from tests.kit.apps import compiled
from tests.paths import ROOT

PAGE = (ROOT / "docs/seam.md").read_text("utf-8")
ORDERS = (ROOT / "runtime/plutoc_runtime/fleet/orders.py").read_text("utf-8")


def test_the_flight_by_hand_is_flown(tmp_path: Path) -> None:
    code, printed = re.findall(r"```(?:python)?\n(.*?)```", PAGE, re.DOTALL)
    package = compiled("drugs_distribution", tmp_path)
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={"PYTHONPATH": str(package / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == (printed, "")


def test_every_call_order_and_command_is_on_it() -> None:
    named = set(re.findall(r"`([\w-]+)", PAGE))
    calls = {name for name in vars(Brain) if not name.startswith("_")}
    assert calls <= named
    ordered = set(re.findall(r'"do": "(\w+)"', ORDERS)) | set(re.findall(r'_ask\("(\w+)"', ORDERS))
    assert ordered
    assert ordered <= named
    assert set(_COMMANDS) <= named
