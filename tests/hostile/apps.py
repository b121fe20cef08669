"""An app with a text in every place that can have one."""

from __future__ import annotations

from plutoc.check.model import Checked
from plutoc.compile import analyse, package_of
from plutoc.emit.package import Package
from plutoc.source import Source
from tests.fuzz.texts import legal

APP = """pluto 1
app crop "{text}" {{
  action spray(note: text = "{text}", dose: mass = 5 g)
  action wave(sign: text = "plain")
  modifier tell(words: text = "{text}", more: text)
  evaluator find
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  say = MissionModifier(hook: tell, words: "{text}", more: "{text}")
  judge = MissionEvaluator(hook: find)
  retry = PriorityManager
  start -> create -> say -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  watch -> judge when COMPLETED
  judge -> allocate when STANDBY
  retry -> allocate when STANDBY
  [judge, retry] -> end otherwise
}}
# {comment}
"""


def app(text: str, comment: str = "plain") -> str:
    """Return a source with a text in all of its strings."""
    return APP.format(text=legal(text), comment=comment)


def checked(text: str, comment: str = "plain") -> Checked:
    """Return the checked graph of it."""
    return analyse(Source("crop.pluto", app(text, comment)))[0]


def package(text: str, source_name: str = "crop.pluto") -> Package:
    """Return the package of it."""
    return package_of(checked(text), source_name=source_name)
