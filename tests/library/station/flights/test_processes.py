"""What becomes of a station that is a process: killed, supervised, beside others, told to end."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from tests.kit.station import Station, Stations, until
from tests.paths import EXAMPLES

Run = Callable[..., Station]


@pytest.fixture
def run(stations: Stations) -> Iterator[Run]:
    """Run stations of one example as processes; leave none behind."""
    begun: list[Station] = []
    missions = os.fspath(EXAMPLES / "drugs_distribution" / "missions.toml")

    def run(*options: str) -> Station:
        speed = () if "--crtp-sim" in options else ("--speed", "30")
        options = ("--missions", missions, *speed, *options)
        begun.append(stations.fresh("drugs_distribution", *options))
        begun[-1].start()
        return begun[-1]

    yield run
    for station in begun:
        station.end()


def flying(station: Station) -> Station:
    assert station.tell("start") == "3 missions started"
    until(lambda: station.in_the_air() != [], "something flies")
    return station


@pytest.mark.process
def test_a_supervised_station_goes_on_by_itself_when_it_is_killed(run: Run) -> None:
    """Open pages keep their access."""
    station = flying(run("--supervise", "--name", "ward.example"))
    assert oct(station.folder.joinpath("station").stat().st_mode)[-2:] == "00"
    before = station.get("/api/app")["server"]
    serving = int((station.folder / "station" / "lock").read_text())
    assert serving != station.pid
    os.kill(serving, signal.SIGKILL)

    def is_another() -> bool:
        try:
            return bool(station.get("/api/app")["server"] != before)
        except OSError:
            return False

    until(is_another, "another process serves")
    until(lambda: station.phase == "over", "the flight is over")
    assert set(station.statuses().values()) == {"COMPLETED"}
    assert set(station.done().values()) <= {1}


@pytest.mark.long
@pytest.mark.process
def test_ctrl_c_lands_all_drones_and_says_so(run: Run) -> None:
    station = flying(run())
    station.end()
    assert "stopping: the drones land where they are" in station.said()
    station.start()
    assert station.phase == "stopped"


@pytest.mark.long
@pytest.mark.process
def test_no_other_station_serves_from_the_same_folder_nor_at_the_same_port(run: Run) -> None:
    station = run()
    with pytest.raises(AssertionError, match="another station is being served from there"):
        replace(station, port=0).start()
    elsewhere = station.folder.parent / "one" / "more"
    elsewhere.parent.mkdir()
    with pytest.raises(AssertionError, match=f"port {station.port} is taken"):
        replace(station, folder=elsewhere).start()
    assert elsewhere.stat().st_mode & 0o777 == 0o700


@pytest.mark.long
@pytest.mark.process
def test_simulated_crazyflies_join_and_begin_the_next_flight_where_the_last_one_has_left_them(
    run: Run,
) -> None:
    """They are connected like real ones; mishaps are not for them."""
    pytest.importorskip("cflib")
    station = flying(run("--crtp-sim", "2"))
    why = station.refused("mishap", drone="cf1", kind="crash")
    assert why == "mishaps happen to drones that --sim simulates, and to no others"
    category = station.get("/api/app")["drones"][0]["category"]
    station.tell("join", drone="cf9", category=category, home=[10.0, 4.0])
    until(lambda: station.drone("cf9")["status"] in ("FREE", "BUSY"), "cf9 is connected")
    station.tell("stop", how="land")
    until(lambda: station.phase == "stopped", "all have landed")
    before = {row["id"]: (row["x"], row["y"]) for row in station.now()["drones"]}
    station.tell("discard")
    station.tell("start")
    until(lambda: station.now()["missions"] != [], "the drones have been asked where they are")
    for row in station.now()["drones"]:
        assert (row["x"], row["y"]) == pytest.approx(before[row["id"]], abs=0.3)
