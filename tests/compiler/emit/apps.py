"""Apps for tests of what is emitted."""

from __future__ import annotations

PLAIN = """\
pluto 1
app plain {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor

  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""
"""Without a title, a hook, a category or a field."""

PARCELS = PLAIN.replace("plain {", "parcels {\n  category carrier can pick_item, release_item")
"""Drones that can do nothing without an item."""

ODD_NAMES = """\
pluto 1
app odd_ "Odd: <b>\\"names\\"</b> `x` ${{ 1 }}" {
  category drone can float, print, builtins, take_photo

  action float(int: float, str: text, bool: bool = yes, object: int) safe
  action print(list: mass, kernel: percent = 40 %) ask
  action builtins
  evaluator hooks
  evaluator str
  modifier flow(list: time = 3 min, func: float = 1.5) emits STANDBY, COMPLETED, FAILED
  modifier mission(at: text = "x")
  policy run

  create = MissionCreator
  status = Clock
  allocate = DroneAllocator(policy: run, allocate_within: 10 min)
  partial = TripLauncher
  dict = TripMonitor
  at = MissionModifier(hook: flow, list: 2 min)
  tuple = GateFIFO
  twist = MissionModifier(hook: mission)
  judge = MissionEvaluator(hook: str)
  retry = PriorityManager

  start -> create -> status -> allocate -> partial -> [dict, at] -> tuple -> twist
  twist -> status when STANDBY
  twist -> retry when FAILED
  twist -> judge when COMPLETED
  retry -> allocate when STANDBY
  retry -> end otherwise
  judge -> status when STANDBY
  judge -> end otherwise
}
"""
"""Names that Python, or the generated code itself, has already."""

TYPED = """\
pluto 1
app typed_ {
  mission has str: text, float: length = 2 m, model: int
  trip has bool: bool, str: text = "", dataclass: percent = 40 %, builtins: float
  trip has warmth: temperature

  action float(int: float) -> float safe
  action weigh -> mass
  action count -> int ask
  action look_at(str: text = "x") -> photo
  action bool -> bool
  action read_label -> text
  evaluator str(least: int = 2, share: percent = 20 %)
  evaluator int(float: float = 0.5)
  modifier note_it

  create = MissionCreator
  note = MissionModifier(hook: note_it)
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: int, float: 1.5)
  retry = PriorityManager

  start -> create -> note -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  watch -> judge when COMPLETED
  [retry, judge] -> allocate when STANDBY
  [retry, judge] -> end otherwise
}
"""
"""Fields of its own, evaluators with parameters, and actions that say what they give; odd names, too."""
