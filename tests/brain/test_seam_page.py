"""The page about the seam says what is so: its example runs, and it names all that there is."""

from __future__ import annotations

import re

import pytest

from pluto_fleet.shared.brain import Brain
from tests.kit import apps
from tests.kit.command import python
from tests.paths import ROOT

PAGE = (ROOT / "docs/seam.md").read_text("utf-8")
BRAIN = ROOT / "runtime/plutoc_runtime"


@pytest.mark.process
def test_the_flight_by_hand_is_flown() -> None:
    code, printed = re.findall(r"```(?:python)?\n(.*?)```", PAGE, re.DOTALL)
    source = apps.compiled("drugs_distribution") / "src"
    done = python("-c", code, PYTHONPATH=str(source))
    assert (done.out, done.err) == (printed, "")


def test_every_call_order_and_command_is_on_it() -> None:
    named = set(re.findall(r"`([\w-]+)", PAGE))
    calls = {name for name in vars(Brain) if not name.startswith("_")}
    orders = (BRAIN / "fleet/orders.py").read_text("utf-8")
    ordered = set(re.findall(r'"do": "(\w+)"', orders))
    commands = set(
        re.findall(r'"([\w-]+)": Control', (BRAIN / "flow/control.py").read_text("utf-8"))
    )
    assert calls and ordered and commands
    assert calls | ordered | commands <= named
