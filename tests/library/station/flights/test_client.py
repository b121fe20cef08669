"""A program flies a station by the Python client."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from pluto_fleet.client import Outdated, Refused
from pluto_fleet.client import Station as Client
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.station.flights.conftest import Serve
from tests.paths import ROOT

PAGE = ROOT / "docs" / "http.md"


def test_the_example_of_the_page_on_the_interface_prints_what_it_says(serve: Serve) -> None:
    station = serve("pm10", "--speed", "30")
    client = Client(station.url)
    revision = client.plan()["revision"]
    emptied = client.replace_plan(revision=revision, missions=[])
    assert emptied["missions"] == []
    with pytest.raises(Outdated) as old:
        client.add_example(revision=revision)
    assert old.value.newest == emptied
    code, output = re.findall(r"```(?:python)?\n(.*?)```", PAGE.read_text(), re.DOTALL)[:2]
    code = code.replace("http://127.0.0.1:8765", station.url)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (run.stdout, run.stderr) == (output, "")
    assert station.audit()[-1]["by"] == "night shift"
    assert "Example 1" in client.plan_file() and "COMPLETED" in str(client.live())
    with pytest.raises(Refused, match="there is nothing to put away") as refused:
        client.discard()
    assert refused.value.status == 409


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("127.0.0.1:8765", "is no address of a station: it is like http://127.0.0.1:8765"),
        ("http://127.0.0.1:99999", "is no address of a station"),
        ("http://127.0.0.1:1", "no station answers at 127.0.0.1:1"),
    ],
)
def test_where_there_is_no_station_a_client_says_so(address: str, said: str) -> None:
    with pytest.raises(BadInput, match=said):
        Client(address).app()
