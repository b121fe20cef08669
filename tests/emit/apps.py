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
