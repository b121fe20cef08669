"""Small files that would become large ones: refused by a process with little memory, and soon."""

from __future__ import annotations

import resource
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.process
RUN = "import sys; from pluto_fleet.cli import main; from tests.library.files.an_app import APP; sys.exit(main(APP, sys.argv[1:]))"
MEMORY = 600 << 20
SECONDS = 120
TRIP = '[[mission.trip]]\naction = "take_photo"\ntarget = ["{x}", 1]\n'
AREA = '[[mission.area]]\naction = "take_photo"\npolygon = [[0, 0], [20, 0], [20, 20]]\nspacing = 0.6\n'


def rows(count: int) -> str:
    return "a,x\n" + "".join(f"{number:013d},1\n" for number in range(count))


@pytest.mark.parametrize(
    ("missions", "given"),
    [
        (f'[[mission]]\nname = "{"{a}" * 8_000}"\neach = "0.csv"\n{TRIP}', [rows(8_000)]),
        (
            "".join(f'[[mission]]\nname = "{n} {{a}}"\neach = "{n}.csv"\n{TRIP}' for n in range(30)),
            [rows(10_000)] * 30,
        ),
        (f'[[mission]]\nname = "{{a}}"\neach = "0.csv"\n{TRIP * 400}', [rows(10_000)]),
        (f'[[mission]]\nname = "{{a}}"\neach = "0.csv"\n{TRIP}x = [{"1," * 400_000}]\n', [rows(100)]),
        (f'[[mission]]\nname = "{{a}}"\neach = "0.csv"\n{AREA}', [rows(10_000)]),
        (f'[[mission]]\nname = "{{a}}"\neach = "0.csv"\n{TRIP}', ["n" * 1_000_000 + "\n1\n"]),
        (f'[[mission]]\nname = "{{a}}"\neach = "0.csv"\n{TRIP}', [f"{'a,' * 500_000}\n1\n"]),
    ],
)  # fmt: skip
def test_what_lists_would_make_is_refused_before_it_is_made(
    tmp_path: Path, missions: str, given: list[str]
) -> None:
    (tmp_path / "m.toml").write_text(missions)
    for number, text in enumerate(given):
        (tmp_path / f"{number}.csv").write_text(text)
    done = subprocess.run(
        [sys.executable, "-c", RUN, "check", str(tmp_path / "m.toml")],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)),
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=False,
    )
    assert done.returncode == 2, done.stderr[-500:]
    assert "m.toml:" in done.stderr and "Traceback" not in done.stderr and len(done.stderr) < 20_000
