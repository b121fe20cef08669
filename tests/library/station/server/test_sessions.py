"""What is answered at each address: requests and answers as a text, in sessions/; `--update` writes them anew.

A request is `> METHOD address body`; a line `: name: value` below it gives it another header, or none. `$now`
in it is the plan's revision, and `local` the address that was connected to. Of a plan its names and its
problems are shown.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, urlsplit

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.station.config import StationConfig
from tests.library.files.an_app import APP, OWN
from tests.library.station.jumping import run
from tests.library.station.map.test_drawn import ward
from tests.library.station.plan.test_library import library

from .asking import OURS, Asked, AStation, Reply, asked, request

SESSIONS = sorted(Path(__file__).parent.glob("sessions/*.txt"))


EVERYWHERE = {
    "host": "0.0.0.0",
    "names": ("ward.example", "far.example:8443"),
    "token": "sesame",
    "watch_token": "poppy",
}
"""How a station is reached by others."""


def whole(folder: Path, app: App, **guard: Any) -> Asked:
    """Return a station with a map, a plan and a library of plans, at which every command can be done."""
    station = AStation(app, StationConfig(folder=folder, fleet=default_fleet(app), faults={}))
    station.map = ward(folder)
    station.library = library(folder, station.plan)
    return asked(station, **guard)


def told(reply: Reply) -> str:
    """Return what there is to see of an answer."""
    text = reply.body.decode(errors="replace")
    if reply.type == "application/json":
        text = json.dumps(_in_short(json.loads(text)), ensure_ascii=False)
        text = re.sub(r'"saved_at": \d+', '"saved_at": 0', text)
        text = re.sub(r"/map\?v=[0-9a-f]+", "/map?v=0", text)
    else:
        text = f"{reply.type} {text!r}"
    return f"{reply.status} {text}"


def _in_short(data: Any) -> Any:
    match data:
        case {"revision": revision, "missions": missions, "problems": problems}:
            names = [one["name"] for one in missions]
            said = [{key: one for key, one in each.items() if one} for each in problems]
            return {"revision": revision, "missions": names, "problems": said}
    return data


def talked(ask: Asked, session: str) -> str:
    """Return the session with the answers as they are now."""
    lines: list[str] = []
    for each in re.findall(r"^> .*(?:\n: .*)*|^#.*|^$", session, re.MULTILINE):
        lines.append(each)
        if not each.startswith("> "):
            continue
        first, *others = each.splitlines()
        first = first.replace("$now", str(ask.station.plan.revision))
        _, method, address, *body = first.split(" ", 3)
        headers = dict(OURS)
        for line in others:
            name, _, value = line.removeprefix(": ").partition(":")
            headers[name] = value.strip()
            if not value.strip():
                del headers[name]
        url = urlsplit(address)
        query = dict(parse_qsl(url.query, keep_blank_values=True))
        ask.times.append(ask.times[-1] + 1.0)  # it is asked as often as it may be
        asks = request(method, url.path, "".join(body), headers, **query)
        asks = replace(asks, local=headers.pop("local", asks.local))
        lines.append(told(run(ask.api.answer(asks))))
    return "\n".join(lines).strip() + "\n"


@pytest.mark.parametrize("file", SESSIONS, ids=lambda file: str(file.stem))
def test_each_request_is_answered_as_it_is_written(
    file: Path, tmp_path: Path, update: bool
) -> None:
    session = file.read_text("utf-8")
    guard = EVERYWHERE if file.stem == "everywhere" else {}
    app = OWN if file.stem == "own_fields" else APP
    now = talked(whole(tmp_path, app, **guard), session)
    if update:
        file.write_text(now, "utf-8")
    assert now == (now if update else session)
