"""What docs/calibration.md shows is what the command prints."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from pluto_fleet.__main__ import main
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.calibrating.flights import surveyed
from tests.paths import ROOT

PAGE = ROOT / "docs" / "calibration.md"
COMMAND = re.compile(r"```console\n\$ pluto-fleet (.*)\n```")
SHOWN = re.compile(r"(?<=## What it prints\n\n```\n).*?(?=```)", re.DOTALL)
FLOWN = replace(
    CRAZYFLIE,
    pace=1.04,
    settles=0.42,
    take_off=2.2,
    landing=2.3,
    spread=0.02,
    action_spread=0.05,
    drain=1.12,
)


def test_it_shows_what_is_printed(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    update: bool,
) -> None:
    monkeypatch.chdir(tmp_path)
    surveyed(Path("flight.journal"), FLOWN, said=CRAZYFLIE, trips=120)
    Path("fleet.toml").write_text('[motion]\nlimit = "1 m/s"\n')
    text = PAGE.read_text("utf-8")
    command, shown = COMMAND.search(text), SHOWN.search(text)
    assert command is not None
    assert shown is not None
    assert main(command[1].split()) == 0
    printed = capsys.readouterr().out
    if update:
        PAGE.write_text(text.replace(shown[0], printed), "utf-8")
    else:
        assert printed == shown[0]
