"""What blocks and apps of seam 2 import from the brain that they carry is found in today's."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from tests.seam.packages import NAME, Kept, environment, unpacked

NAMES = {
    "domain.actions": ("BUILT_IN", "Parameter"),
    "domain.app": ("App",),
    "domain.errors": ("ActionFailed", "MissionFailed", "nothing_to_fly"),
    "domain.fields": ("Entity", "Field", "FieldType"),
    "domain.model": ("Category", "Drone", "Item", "Photo", "Point", "Trip"),
    "domain.quantities": ("Type",),
    "domain.results": ("Result", "Results"),
    "domain.status": (
        *("COMPLETED", "FAILED", "RUNNING", "STANDBY", "WORST_FIRST"),
        *("Status", "TripStatus"),
    ),
    "domain.text": ("duration",),
    "fleet.policies.batch_optimal": ("batch_optimal",),
    "fleet.policies.first": ("first",),
    "fleet.policies.least_used": ("least_used",),
    "fleet.policies.nearest": ("nearest",),
    "fleet.policies.own": ("own_policy",),
    "fleet.queue": ("Policy", "Request"),
    "flow.declared": ("declared",),
    "flow.judgement": ("apply",),
    "flow.modification": ("context_of", "open_trips", "settle"),
    "flow.own_action": ("OwnAction",),
    "flow.run": ("Branch", "Run", "watch"),
    "flow.verdict": ("Verdict",),
    "hooks.context": ("Context",),
    "hooks.live_drone": ("LiveDrone",),
    "time.future": ("Future",),
    "time.kernel": ("EventKind", "Task"),
    "trips.deadlines": ("Limit",),
}
"""By former module: the imports of all blocks of that time, and of what was generated."""

PROGRAM = f"""
import json, sys
from importlib import import_module
from pluto_fleet.older import provide
provide("{NAME}._runtime")
for module, names in json.loads(sys.argv[1]).items():
    found = import_module(f"{NAME}._runtime.{{module}}")
    print(*(f"{{module}}.{{name}}" for name in names if not hasattr(found, name)), end="")
"""


def test_each_former_name_is_found(tmp_path: Path) -> None:
    """In a process of its own, which has met an app of that time."""
    package = unpacked(Kept("2.0", NAME), tmp_path)
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(NAMES)],
        env=environment(package),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
