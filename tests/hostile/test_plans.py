"""Plan files from a stranger: `APP check` tells what is wrong with them, and nothing else happens."""

from __future__ import annotations

import os
from itertools import product
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import main
from tests.library.files.an_app import APP, OWN

HERE = Path(__file__).with_name("plan")
MISSIONS = (HERE / "missions.toml").read_text(encoding="utf-8")
OWN_MISSIONS = (HERE / "own_missions.toml").read_text(encoding="utf-8")
FLEET = (HERE / "fleet.toml").read_text(encoding="utf-8")
VALUES = (
    *("1e400", "-1e400", "nan", "-nan", "inf", "-inf", "1e308", "5e-324", "-0.0"),
    *("9223372036854775807", "-1", "0", "9" * 400, "9" * 5000, "0x" + "f" * 300),
    *("true", "[]", "[[]]", "{}", "{ a = 1 }", "[1e400, nan]", "[0, 0, 0, 0]", '""', '" "', '"x"'),
    *('"1e400 s"', '"nan m"', '"inf g"', '"9e999 min"', '"-5 s"', '"5 parsec"', '"24:00"'),
    *("1979-05-27", "1979-05-27T07:32:00Z", "07:32:00", "00:00:60"),
    *('"\\u0000"', '"\\u001b[31m"', '"\\u202e"', '"../../etc/passwd"', '"$(touch hacked)"'),
    *('"' + "x" * 5000 + '"', '"::error::x"', '"<script>"', '"\\U0010FFFF"', "'''\n'''"),
    *("[" * 50 + "]" * 50, "[" * 3000 + "]" * 3000, "{ a = " * 60 + "1" + " }" * 60),
)


EVERY = 11
"""Each value is put into one line of so many; with the next value it is the next line."""


def assignments(text: str, number: int) -> list[str]:
    """Return some of the lines that give something a value, others for each number."""
    lines = [line for line in text.splitlines() if "=" in line]
    return [line for place, line in enumerate(lines) if (place + number) % EVERY == 0]


def check(
    folder: Path,
    missions: bytes,
    fleet: bytes,
    capfd: pytest.CaptureFixture[str],
    app: App = APP,
) -> str:
    """Check a plan; it ends with 0, 1 or 2, and with a few lines that a terminal can show."""
    (folder / "m.toml").write_bytes(missions)
    (folder / "f.toml").write_bytes(fleet)
    capfd.readouterr()
    code = main(app, ["check", str(folder / "m.toml"), "--fleet", str(folder / "f.toml")])
    out, err = capfd.readouterr()
    assert code in (0, 1, 2), (err, missions, fleet)
    assert (code == 0) == bool(out)
    assert all(char == "\n" or char.isprintable() for char in err), ascii(err)
    assert len(err) < 20_000
    assert "set_int_max" not in err  # Python's own hint
    assert sorted(os.listdir(folder)) == ["f.toml", "m.toml"]
    return err


PLAIN_FLEET = '[[drone]]\nid = "a"\nhome = [1, 1]\n'


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_any_value_in_any_place_is_taken_or_refused(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], number: int
) -> None:
    """Numbers beyond all limits, wrong types, deep nesting, texts that try to be commands."""
    for missions, fleet, app in (
        (MISSIONS, FLEET, APP),
        (OWN_MISSIONS, PLAIN_FLEET, OWN),
    ):
        for text in (missions, fleet):
            for line in assignments(text, number):
                changed = text.replace(line, f"{line.partition('=')[0]}= {VALUES[number]}", 1)
                plan = [changed if one is text else one for one in (missions, fleet)]
                said = check(tmp_path, plan[0].encode(), plan[1].encode(), capfd, app)
                assert "m.toml" in said or "f.toml" in said or not said


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 100_000,
        "a = " + "{ b = " * 100_000,
        "[" * 100_000,
        "a." * 100_000 + "b = 1",
        "[" + "a." * 20_000 + "b]",
        'a = "' + "\\" * 100_000,
        'a = """' + "x" * 900_000,
        "[[mission]]\n" * 20_000,
        "[[mission]]\n[[mission.trip]]\n" + "k = 1\n" * 2,
        "[[mission]]\n" + "".join(f"k{i} = 1\n" for i in range(20_000)),
        "mission = " + "[" + "{}," * 20_000 + "]",
        "mission.trip.action = 1",
        "[mission]",
        "x" * 900_000,
        "=" * 900_000,
        "\n" * 900_000,
        "#" * 2_000_000,
    ],
    ids=range(17),
)
def test_a_file_that_no_compiler_wrote_is_refused(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], text: str
) -> None:
    """Deep, long, large: as missions and as a fleet."""
    assert "m.toml" in check(tmp_path, text.encode(), FLEET.encode(), capfd)
    assert "toml" in check(tmp_path, MISSIONS.encode(), text.encode(), capfd)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (MISSIONS.encode() + b"\0", "m.toml:"),
        (MISSIONS.encode() + b"\xff", "is not UTF-8 text"),
        (MISSIONS.encode("utf-16"), "is not UTF-8 text"),
        (b"\xef\xbb\xbf" + MISSIONS.encode(), ""),
        (MISSIONS.encode().replace(b"\n", b"\r\n"), ""),
        (MISSIONS.encode().replace(b"\n", b"\r"), "m.toml:"),
        (MISSIONS.encode().replace(b"North", "N\N{RIGHT-TO-LEFT OVERRIDE}h".encode()), "m.toml:"),
        (b"", "m.toml"),
    ],
    ids=range(8),
)
def test_odd_bytes_are_read_or_refused(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], data: bytes, said: str
) -> None:
    """As in a source."""
    found = check(tmp_path, data, FLEET.encode(), capfd)
    assert said in found
    assert bool(found) == bool(said)


def test_what_is_no_file_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """A pipe into which nothing is written, a device, a folder, a link in a circle."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "good.toml").write_text(MISSIONS)
    odd = [str(tmp_path / "pipe"), str(tmp_path / "loop"), str(tmp_path), "/dev/zero", "no\0file"]
    for missions, fleet in product([*odd, str(tmp_path / "good.toml")], odd):
        assert main(APP, ["check", missions, "--fleet", fleet]) == 2
        assert capfd.readouterr().err


FLAGS = (
    *("simulate M.toml --seed N", "simulate M.toml --runs N", "simulate M.toml --until Ns"),
    *("simulate M.toml --until N", "size M.toml --jobs N", "fly M.toml --crtp-sim N"),
    *("fly M.toml --sim --speed N", "serve --sim --port N", "tell J prioritise M T --to N"),
)


@pytest.mark.parametrize("line", FLAGS)
def test_a_flag_of_many_digits_is_refused_in_a_sentence(
    capfd: pytest.CaptureFixture[str], line: str
) -> None:
    assert main(APP, line.replace("N", "9" * 5000).split()) == 2
    told = capfd.readouterr().err
    assert len(told) < 3_000 and "set_int_max" not in told
