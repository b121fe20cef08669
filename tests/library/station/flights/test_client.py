"""Programs fly a station by the Python client, and watch it; what it answers is as it is described."""

from __future__ import annotations

import asyncio
import json
import re
import runpy
from collections.abc import Callable
from contextlib import redirect_stdout
from io import BytesIO, StringIO
from typing import Any
from zipfile import ZipFile

import pytest
from jsonschema import Draft202012Validator

from pluto_fleet.client import Outdated, Refused
from pluto_fleet.client import Station as Client
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.web.handlers import DESCRIPTION
from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown
from tests.library.station.server.serving import hosted
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "http.md").read_text("utf-8")
DESCRIBED = json.loads(DESCRIPTION.read_text("utf-8"))


def beside(station: Flown, program: Callable[[str], None], **guard: Any) -> None:
    """Serve a station, and run a program that is told where."""

    async def both() -> None:
        async with hosted(station.served, **guard) as guarded:
            await asyncio.to_thread(program, f"http://127.0.0.1:{guarded.port}")

    station.world.loop.goes_on = True
    station.world.run(both())
    station.world.loop.goes_on = False


def test_the_example_of_the_page_on_the_interface_prints_what_it_says(serve: Serve) -> None:
    station, said = serve("pm10", speed=300.0), StringIO()
    code, output = re.findall(r"```(?:python)?\n(.*?)```", PAGE, re.DOTALL)[:2]

    def program(url: str) -> None:
        example = station.folder / "example.py"
        example.write_text(code.replace("http://127.0.0.1:8765", url), "utf-8")
        client = Client(url)
        revision = client.plan()["revision"]
        emptied = client.replace_plan(revision=revision, missions=[])
        assert emptied["missions"] == []
        with pytest.raises(Outdated) as old:
            client.add_example(revision=revision)
        assert old.value.newest == emptied
        with redirect_stdout(said):
            runpy.run_path(str(example))
        assert "Example 1" in client.plan_file() and "COMPLETED" in str(client.live())
        with pytest.raises(Refused, match="there is nothing to put away") as refused:
            client.discard()
        assert refused.value.status == 409

    beside(station, program)
    assert said.getvalue() == output
    assert "night shift" in [line.get("by") for line in station.audit()]


def test_the_example_of_a_program_that_raises_events_prints_what_it_says(serve: Serve) -> None:
    station = serve("pursue", speed=20.0)
    said = StringIO()
    code, output = re.findall(r"```(?:python)?\n(.*?)```", PAGE, re.DOTALL)[2:4]

    def program(url: str) -> None:
        example = station.folder / "example.py"
        example.write_text(code.replace("http://127.0.0.1:8765", url), "utf-8")
        with redirect_stdout(said):
            runpy.run_path(str(example))

    beside(station, program)
    assert said.getvalue() == output
    happened = station.events("event.raised")
    assert len({one["id"] for one in happened}) == len(happened)


def test_an_event_in_json_happens_as_the_page_says_and_what_cannot_be_is_told_with_409(
    serve: Serve,
) -> None:
    station = serve("pursue", speed=20.0)
    path, body, answer = re.findall(
        r"8765(/api/events/\w+) .*\n *-d '(.*)'\n(.*)\n```", PAGE, re.MULTILINE
    )[0]
    given = json.loads(body)
    assert station.ask("POST", path, given).status == 409  # nothing flies
    station.flying()
    assert station.ask("POST", path, {**given, "id": ""}).status == 400
    for wrong in ({"at": [-1.0, 0.0]}, {"fields": {"size": 3}}, {"mission": "nobody's"}):
        assert station.ask("POST", path, {**given, "id": str(wrong), **wrong}).status == 409
    assert station.ask("POST", f"{path}s", {"id": "of another name"}).status == 409
    answered = station.ask("POST", path, given)  # a refusal of an event is not kept for its id
    assert answered.body.decode() == answer
    happened = [one for one in station.events("event.raised") if one["id"] == given["id"]]
    fields = {"reach": 0.7, "bound": 5.0, **given["fields"]}  # the others by default
    assert [(one["at"][:2], one["fields"]) for one in happened] == [(given["at"], fields)]


def test_who_watches_sees_what_is_flown_and_by_whom_and_commands_nothing(serve: Serve) -> None:
    station = serve(speed=1.0)

    def program(url: str) -> None:
        flies = Client(f"{url}#token=sesame", who="Zübeyde")
        watches = Client(f"{url}#token=poppy", who="Ben")
        assert (flies.app()["role"], watches.app()["role"]) == ("fly", "watch")
        flies.start()
        with pytest.raises(Refused, match="may watch and not command") as refused:
            watches.stop(how="land")
        assert refused.value.status == 403
        assert watches.live()["state"]["phase"] == "flying"
        with pytest.raises(Refused, match="this needs the token"):
            Client(url).plan()

    beside(station, program, names=("ward.example",), token="sesame", watch_token="poppy")
    assert [begun["by"] for begun in station.events("journal.begun")] == ["Zübeyde"]


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


def holds(answer: Any, name: str) -> None:
    """Hold an answer to a type of the description."""
    schema = {**DESCRIBED, "$ref": f"#/components/schemas/{name}"}
    Draft202012Validator(schema).validate(answer)


def test_a_flight_is_told_as_it_is_described_and_the_same_by_the_next_station(serve: Serve) -> None:
    station = serve("alfalfa")
    holds(station.get("/api/app"), "AppData")
    holds(station.get("/api/plan"), "PlanData")
    holds(station.now(), "LiveMessage")
    station.tell("start")

    def actions() -> list[str]:
        return [str(one.get("action")) for one in station.get("/api/results.json")]

    station.until(lambda: "pollinate" in actions(), "a trip that a hook has added is flown")
    flying = station.now()
    assert flying["log"] and flying["drones"]
    holds(flying, "LiveMessage")
    station.tell("stop", how="land")
    station.comes_to("stopped")
    holds(station.now(), "LiveMessage")
    holds(station.get("/api/plan"), "PlanData")
    results = station.get("/api/results.json")
    photos = [one for one in results if one["action"] == "take_photo"]
    assert all(one["kind"] == "photo" and len(one["target"]) == 3 for one in photos)
    dose = next(one for one in results if one["action"] == "pollinate")
    assert (dose["kind"], dose["parameters"]) == ("handling", {"dose": 2e-05})
    station.start()
    assert station.get("/api/results.json") == results
    assert station.ask("GET", "/api/results.json", flight="nowhere").status == 404
    packed = station.ask("GET", "/api/results.zip").body
    with ZipFile(BytesIO(packed)) as archive:
        assert archive.read("results.csv") == station.ask("GET", "/api/results.csv").body
    features = station.get("/api/results.geojson", flight=station.journals()[0].stem)["features"]
    assert {one["id"] for one in features} <= {one["number"] for one in results} and features
