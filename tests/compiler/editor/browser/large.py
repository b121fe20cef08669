"""An app of three hundred blocks: stage after stage, each with eight branches."""

from __future__ import annotations

STAGES, BRANCHES, DEEP, WAITS = 11, 7, 3, 13


def large() -> str:
    """Return its text."""
    waits = [f"wait_{i}" for i in range(WAITS)]
    blocks = ["create = MissionCreator", *(f"{wait} = Clock" for wait in waits)]
    flows = [f"start -> create -> {' -> '.join(waits)} -> allocate_0"]
    for n in range(STAGES):
        blocks += [
            f"allocate_{n} = DroneAllocator",
            f"launch_{n} = TripLauncher",
            f"watch_{n} = TripMonitor",
            f"all_{n} = GateFunnel",
            f"retry_{n} = PriorityManager",
        ]
        flows.append(f"allocate_{n} -> launch_{n} -> watch_{n} -> all_{n}")
        for branch in range(BRANCHES):
            notes = [f"note_{n}_{branch}_{i}" for i in range(DEEP)]
            blocks += [f"{note} = MissionModifier(hook: note)" for note in notes]
            flows.append(f"launch_{n} -> {' -> '.join(notes)} -> all_{n}")
        flows += [
            f"all_{n} -> allocate_{(n + 1) % STAGES} when STANDBY",
            f"all_{n} -> retry_{n} when FAILED",
            f"all_{n} -> end when COMPLETED",
            f"retry_{n} -> allocate_{n} when STANDBY",
            f"retry_{n} -> end otherwise",
        ]
    lines = "".join(f"  {line}\n" for line in ("modifier note", "", *blocks, "", *flows))
    return f'pluto 1\n\napp large "Three hundred blocks" {{\n{lines}}}\n'
