"""Ten Crazyflies in the air at once, crossing each other's ways home: Stop brings all of them down.

How long it takes is printed and not judged here, where a busy machine would be judged with it:
`tests/library/gateway/traffic/test_real_descents.py` does it in virtual time, with real drones' profiles,
and `python -m tests.flights_crazyflie.together` on a quiet machine.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.flights_crazyflie.plans import DISTRIBUTION, quick_package
from tests.flights_crazyflie.together import Figures, stopped

pytest.importorskip("cflib")
# a minute in real time; tests/library/gateway/traffic does it in virtual time
pytestmark = pytest.mark.long

SPEED = 1.0
"""Metres per second; with `python -m tests.flights_crazyflie.together` they take their time."""


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app's package is imported from."""
    return quick_package(tmp_path_factory.mktemp("quick"), SPEED, DISTRIBUTION)


def landed(how: str, source: Path, folder: Path) -> Figures:
    """Fly until it is the drones that are judged, and not a machine that stood still for a second."""
    for attempt in range(2):
        try:
            return stopped(how, source, folder / str(attempt), SPEED)
        except AssertionError as error:
            if "told nothing for" not in str(error):
                raise
    return stopped(how, source, folder, SPEED)


@pytest.mark.parametrize("how", ["land", "rtl"])
def test_all_come_down_where_they_should_and_never_too_near(
    how: str, source: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    figures = landed(how, source, tmp_path)
    with capsys.disabled():
        print(f"\n{figures}")
    assert figures.problems == ()
