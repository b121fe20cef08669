"""What is answered at each address: requests and answers as a text, in sessions/; `--update` writes them anew.

A request is `> METHOD address body`; a line `: name: value` below it gives it another header, or none. `$now`
in it is the plan's revision. Of a plan its names and its problems are shown.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, urlsplit

import pytest

from pluto_fleet.station.web.http import Reply
from tests.library.station.map.test_drawn import ward
from tests.library.station.plan.test_library import library

from .asking import OURS, Asked, AStation, asked

SESSIONS = sorted(Path(__file__).parent.glob("sessions/*.txt"))


def whole(folder: Path) -> Asked:
    """Return a station with a map, a plan and a library of plans, at which every command can be done."""
    station = AStation(map=ward(folder))
    station.library = library(folder, station.plan)
    return asked(station)


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
    for request in re.findall(r"^> .*(?:\n: .*)*|^#.*|^$", session, re.MULTILINE):
        lines.append(request)
        if not request.startswith("> "):
            continue
        first, *others = request.splitlines()
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
        lines.append(told(ask(method, url.path, "".join(body), headers, **query)))
    return "\n".join(lines).strip() + "\n"


@pytest.mark.parametrize("file", SESSIONS, ids=lambda file: str(file.stem))
def test_each_request_is_answered_as_it_is_written(
    file: Path, tmp_path: Path, update: bool
) -> None:
    session = file.read_text("utf-8")
    now = talked(whole(tmp_path), session)
    if update:
        file.write_text(now, "utf-8")
    assert now == (now if update else session)
