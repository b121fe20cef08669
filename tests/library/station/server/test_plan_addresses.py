"""The library of plans, by its addresses."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pluto_fleet.station.web.http import Reply
from tests.library.station.plan.drawing import a_plan, mission
from tests.library.station.plan.test_library import library

from .asking import Asked, AStation, asked, without


def of(reply: Reply) -> Any:
    return json.loads(reply.body)


def asking(folder: Path) -> Asked:
    """Return a station with a real plan, and its library."""
    plan = a_plan()
    station: Any = AStation()
    station.plan, station.library = plan, library(folder, plan)
    return asked(station)


def drawn(ask: Asked, *missions: object) -> int:
    """Draw a plan, and return its revision."""
    revision = of(ask("GET", "/api/plan"))["revision"]
    reply = ask("PUT", "/api/plan", {"revision": revision, "missions": missions})
    assert reply.status == 200
    return int(of(reply)["revision"])


def test_a_plan_is_kept_opened_deleted_and_restored(tmp_path: Path) -> None:
    """Each answer has the newest of what was changed."""
    ask = asking(tmp_path)
    revision = drawn(ask, mission(name="A"))
    reply = ask("PUT", "/api/plans", {"by": "Ada", "template": True}, name="Beds")
    [plan] = of(reply)["plans"]
    assert (plan["name"], plan["by"], plan["template"], plan["missions"]) == (
        "Beds",
        "Ada",
        True,
        1,
    )
    assert ask("PUT", "/api/plans", {}, name="Beds").status == 409
    added = ask("POST", "/api/plans/open", {"name": "Beds", "revision": revision, "add": True})
    assert [one["name"] for one in of(added)["missions"]] == ["A", "A 2"]
    late = ask("POST", "/api/plans/open", {"name": "Beds", "revision": revision})
    assert (late.status, len(of(late)["missions"])) == (409, 2)
    newest = {"name": "Beds", "revision": of(added)["revision"]}
    opened = ask("POST", "/api/plans/open", newest)
    assert [one["name"] for one in of(opened)["missions"]] == ["A"]
    [thrown] = of(ask("DELETE", "/api/plans", name="Beds"))["trash"]
    assert ask("POST", "/api/plans/open", newest).status == 409
    assert of(ask("POST", "/api/plans/restore", {"id": thrown["id"]}))["plans"][0]["by"] == "Ada"
    assert of(ask("GET", "/api/plans"))["trash"] == []


def test_no_other_site_and_no_path_reaches_the_library(tmp_path: Path) -> None:
    ask = asking(tmp_path)
    drawn(ask, mission())
    assert ask("PUT", "/api/plans", {}, without("x-pluto"), name="A").status == 403
    assert ask("PUT", "/api/plans", {}, without(content_type="text/plain"), name="A").status == 415
    for name in ("../A", "", ".x"):
        assert ask("PUT", "/api/plans", {}, name=name).status == 409
        assert ask("DELETE", "/api/plans", name=name).status == 409
    assert list(tmp_path.iterdir()) == []
