"""What blocks and apps of seam 1 import from the brain that they carry is found in today's."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from tests.seam.packages import NAME, Kept, environment, unpacked

NAMES = {
    "actions": ("Action", "BUILT_IN", "Parameter"),
    "app": ("App",),
    "context": ("Context",),
    "errors": ("ActionFailed", "MissionFailed", "nothing_to_fly"),
    "fields": ("Entity", "Field", "FieldType"),
    "flight": ("launch",),
    "handle": ("LiveDrone",),
    "judgement": ("apply",),
    "kernel": ("Kind", "Task"),
    "model": ("Category", "Drone", "Item", "Photo", "Point", "Trip"),
    "modification": ("settle", "standing"),
    "policies.batch_optimal": ("batch_optimal",),
    "policies.first": ("first",),
    "policies.least_used": ("least_used",),
    "policies.nearest": ("nearest",),
    "policies.own": ("own_policy",),
    "policy": ("Policy",),
    "quantities": ("Type",),
    "request": ("Request",),
    "run": ("Branch", "Run"),
    "signals": ("Signal",),
    "status": (
        *("COMPLETED", "FAILED", "RUNNING", "STANDBY", "WORST_FIRST"),
        *("Status", "TripStatus"),
    ),
    "verdict": ("Verdict",),
    "watching": ("Limit", "watch"),
    "words": ("duration",),
}
"""By former module: the imports of all blocks of that time, and of what was generated."""

PROGRAM = f"""
import json, sys
from importlib import import_module
from pluto_fleet.seam import meet
assert meet({NAME!r}, "{NAME}._runtime", (1, 0))
for module, names in json.loads(sys.argv[1]).items():
    found = import_module(f"{NAME}._runtime.{{module}}")
    print(*(f"{{module}}.{{name}}" for name in names if not hasattr(found, name)), end="")
"""


def test_each_former_name_is_found(tmp_path: Path) -> None:
    """In a process of its own, which has met an app of that time."""
    package = unpacked(Kept("1.0", NAME), tmp_path)
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(NAMES)],
        env=environment(package),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
