"""Fields of an app's own, while it is written: offered, explained, listed, edited and renamed."""

from __future__ import annotations

from plutoc.edits import applied
from plutoc.service.document import Document
from plutoc.service.editing.edit import edit
from plutoc.service.editing.operations import Rename
from plutoc.service.hooks.help import hover as hover_in_hooks
from plutoc.service.reading.outline import outline
from plutoc.source import Source

GRAPH = """
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: find_blooms, least: 3)
  note = MissionModifier(hook: note_it)

  start -> create -> wait -> note -> allocate -> launch -> watch
  watch -> wait when STANDBY
  watch -> end when FAILED
  watch -> judge when COMPLETED
  judge -> wait when STANDBY
  judge -> end otherwise
}
"""
APP = f"""pluto 1

app field {{
  mission has owner: text, margin: time = 10 min  # which is theirs
  trip has owner: text = "", depth: length = 30 cm

  action spray(dose: mass) -> float once
  evaluator find_blooms(least: int = 2)
  modifier note_it writes margin
{GRAPH}"""
HOOKS = """from . import Context, Drone, Mission, Results, Trip, Verdict


async def spray(drone: Drone, trip: Trip, context: Context, *, dose: float) -> float:
    return dose if trip.owner else 0.0


def find_blooms(mission: Mission, results: Results, *, least: int) -> Verdict:
    owner = mission.owner
    for one in mission.completed_trips:
        if one.owner != owner:
            return Verdict(add=[Trip(name="again", action="measure", target=(1, 2), owner=owner)])
    return Verdict(log=[mission.owner, f"{mission.current.owner}"])


def note_it(mission: Mission, context: Context) -> None:
    mission.margin += 1.0
"""


def document(text: str = APP) -> Document:
    hooks = Source("hooks.py", HOOKS)
    return Document(path="field.pluto", text=text, find_hooks=lambda _: hooks)


def test_the_outline_has_each_field() -> None:
    (app,) = outline(document())
    listed = [(one.name, one.detail) for one in app.children]
    assert listed[1:3] == [("margin", "mission has, time"), ("owner", "trip has, text")]


def test_hooks_are_told_what_results_can_be() -> None:
    code = (
        "def find_blooms(mission: Mission, results: Results, *, least):\n    results.new[0].value"
    )
    found = hover_in_hooks(document(), code, len(code))
    assert found is not None and "float | Photo | None" in found.markdown


def test_a_field_is_renamed_wherever_it_is_that_one() -> None:
    """`owner` of missions, and not that of trips: by what the names around it are."""
    found = edit(document(), Rename(name="mission.owner", new="client"))
    text = applied(Source("field.pluto", APP), found.edits)
    assert text == APP.replace("mission has owner", "mission has client")
    assert "where one has `owner`, write `client`" in found.note
    hooks = applied(Source("hooks.py", HOOKS), found.hooks)
    assert hooks == HOOKS.replace("mission.owner", "mission.client")
    found = edit(document(), Rename(name="trip.owner", new="client"))
    hooks = applied(Source("hooks.py", HOOKS), found.hooks)
    for old in ("trip.owner", "one.owner", "owner=owner", "mission.current.owner"):
        assert old in HOOKS and old not in hooks
    assert "owner = mission.owner" in hooks and "client=owner" in hooks
