"""What the command line takes and refuses."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP


def test_check_says_that_the_fleet_can_fly_the_plan(missions: Path, command: Command) -> None:
    """In one line."""
    said = "2 missions with 3 trips: a fleet of 5 drones can fly them\n"
    assert command("check", missions) == (0, said, "")


def test_check_warns_of_a_speed_that_a_crazyflie_does_not_follow(
    missions: Path, command: Command
) -> None:
    """Before a person stands there with drones that will not take off; other drones may."""
    first, *others = APP.categories
    fast = replace(APP, categories=(replace(first, speed=1.5), *others))
    fleet = missions.with_name("f.toml")
    drones = [
        f'[[drone]]\nid = "{one.name}"\ncategory = "{one.name}"\nhome = [{at}, 1]\n'
        for at, one in enumerate(APP.categories, 1)
    ]
    fleet.write_text("".join(drones))
    code, _, said = command("check", missions, "--fleet", fleet, app=fast)
    assert code == 0 and said.count("\n") == 1
    assert said.startswith(
        f'{fleet}: warning: drones of the category "{first.name}" fly at up to 1.5 m/s: a Crazyflie'
        " follows no course faster than 1 m/s as its firmware comes"
    )
    assert command("check", missions, "--fleet", fleet)[2] == ""
    fleet.write_text('[fleet]\nnavigation = "wren:Wren"\n' + fleet.read_text())
    assert command("check", missions, "--fleet", fleet, app=fast)[2] == ""


@pytest.mark.parametrize("words", ["tell N stop", "journal N --mend", "check N", "resume N --sim"])
def test_a_name_that_is_too_long_is_told(words: str, command: Command) -> None:
    code, _, said = command(*words.replace("N", "n" * 300).split())
    assert code == 2
    assert "too long" in said and "internal" not in said


@pytest.mark.parametrize("words", ["check", "simulate", "journal", "resume", "tell"])
def test_no_file_name_commands_the_terminal(words: str, command: Command) -> None:
    code, out, said = command(words, "\x1b[2J\x07", *(["stop"] if words == "tell" else []))
    assert code == 2
    assert "\x1b" not in out + said and "\\x1b[2J" in said


def test_check_warns_of_names_that_look_alike(missions: Path, command: Command) -> None:
    """It is a plan that can be flown all the same."""
    text = missions.read_text()
    missions.write_text(text + text.replace('"North"', '"north"').replace('"South"', '"S"'))
    code, _, said = command("check", missions)
    assert code == 0
    assert said.startswith(
        f'{missions}: warning: two missions are easily taken for one another, "North" and "north"'
    )


def test_a_plan_that_unflyable_trips_is_refused(missions: Path, command: Command) -> None:
    """By check and simulate alike, before anything starts."""
    fleet = missions.with_name("f.toml")
    fleet.write_text('[[drone]]\nid = "a"\ncategory = "scout"\nhome = [1, 1]\n')
    said = (
        f'{missions}: mission "North", trip 2: no drone of the fleet can do it: '
        "scout cannot pollinate\n"
    )
    assert command("check", missions, "--fleet", fleet) == (2, "", said)
    assert command("simulate", missions, "--fleet", fleet) == (2, "", said)


def test_a_bad_file_is_exit_2(missions: Path, command: Command) -> None:
    """Both files."""
    assert command("check", missions, "--fleet", missions)[0] == 2
    missing = missions.with_name("none.toml")
    said = f"{missing}: there is no such file\n"
    assert command("simulate", missing) == (2, "", said)


def test_real_drones_need_a_fleet_file(missions: Path, command: Command) -> None:
    """Drones that are not named are not flown."""
    code, out, err = command("fly", missions)
    assert (code, out) == (2, "")
    assert err.startswith("alfalfa: "), err
    assert "--fleet" in err


@pytest.mark.parametrize("flag", ["--speed 3", "--seed 3", "--fail crash=1%"])
def test_what_only_simulated_drones_obey_goes_with_sim(
    missions: Path, command: Command, flag: str
) -> None:
    """Real drones fly as fast as they fly, and fail when they do."""
    said = f"{flag.split()[0]} is for simulated drones: it goes with --sim\n"
    assert command("fly", missions, *flag.split()) == (2, "", said)
    code, out, err = command("fly", missions, "--crtp-sim", "3", *flag.split())
    assert (code, out) == (2, "")
    assert err.startswith(f"{flag.split()[0]} does not go with --crtp-sim"), err


@pytest.mark.parametrize(
    ("argv", "said"),
    [
        ("", "the following arguments are required: COMMAND"),
        ("soar m.toml", "argument COMMAND: invalid choice: 'soar'"),
        ("simulate", "the following arguments are required: M.toml"),
        ("fly", "the following arguments are required: M.toml"),
        ("check m.toml --seed 1", "unrecognized arguments: --seed 1"),
        ("simulate m.toml --unt 3", "there is no option --unt; did you mean --until?"),
        ("simulate --fial=crash=1%", "there is no option --fial; did you mean --fail?"),
        ("simulate m.toml --bogus", "unrecognized arguments: --bogus"),
        ("simlate m.toml", "; did you mean simulate?"),
        ("tell j stpo", "; did you mean stop?"),
        ("serve --going-in", "unrecognized arguments: --going-in"),  # a hidden one is not proposed
        ("simulate m.toml --seed x", 'argument --seed: "x" is not a whole number'),
        ("simulate m.toml --runs 0", 'argument --runs: "0" is less than 1'),
        ("simulate m.toml --runs 2 --trace t", "--trace writes down one run"),
        ("simulate m.toml --until 0", 'argument --until: "0" is not more than 0'),
        ("simulate m.toml --until 3m", 'argument --until: "3m" is a length, not a time'),
        ("simulate m.toml --fail crash", '"crash" is not written like crash=10%'),
        ("simulate m.toml --fail fire=1%", '"fire" cannot go wrong; what can: crash, link'),
        ("simulate m.toml --fail crash=1%,crash=2%", "crash is given twice"),
        ("simulate m.toml --fail crash=10", "crash=10 is not between 0% and 100%"),
        ("simulate m.toml --fail crash=x", "crash=x is not a percentage"),
    ],
)
def test_wrong_usage_is_exit_2(argv: str, said: str, command: Command) -> None:
    """With the usage and what is wrong, on standard error, without colours."""
    code, out, err = command(*argv.split())
    assert (code, out) == (2, "")
    assert err.startswith("usage: alfalfa")
    assert said in err
    assert "\x1b" not in err


def test_help_is_exit_0(command: Command) -> None:
    """It names the app and its commands."""
    code, out, _ = command("--help")
    assert code == 0
    assert "Alfalfa crop monitoring" in out
    for name in ("simulate", "check", "fly"):
        assert command(name, "--help")[0] == 0
        assert name in out


SCRIPT = "import sys; from tests.library.files.an_app import APP; import pluto_fleet.cli as c; "


def in_a_process(code: str, missions: Path, stdout: int) -> subprocess.CompletedProcess[str]:
    path = f"import sys; sys.path[:0] = {sys.path!r}; "
    argv = [sys.executable, "-c", path + SCRIPT + code, str(missions)]
    return subprocess.run(argv, text=True, stdout=stdout, stderr=subprocess.PIPE, check=False)


def test_a_closed_pipe_is_silent(missions: Path) -> None:
    """The reader of the output knows that he has gone."""
    code = "sys.exit(c.main(APP, ['simulate', sys.argv[1]]))"
    read, write = os.pipe()
    os.close(read)
    done = in_a_process(code, missions, stdout=write)
    os.close(write)
    assert (done.returncode, done.stderr) == (141, "")


def test_a_full_disk_is_told_once(missions: Path) -> None:
    """And Python says nothing of its own at its end."""
    with open("/dev/full", "w") as full:
        code = "sys.exit(c.main(APP, ['simulate', sys.argv[1]]))"
        done = in_a_process(code, missions, stdout=full.fileno())
    assert done.returncode == 2
    assert done.stderr == "alfalfa: the output cannot be written: No space left on device\n"


def test_check_imports_no_event_loop(missions: Path) -> None:
    """A command brings in only what it needs."""
    code = "c.main(APP, ['check', sys.argv[1]]); sys.exit('asyncio' in sys.modules)"
    assert in_a_process(code, missions, stdout=subprocess.DEVNULL).returncode == 0
