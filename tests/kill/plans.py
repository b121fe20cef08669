"""What is flown while processes are killed: examples that carry things, and our own apps, on a small map."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tests.kit.apps import compiled_file

HERE = Path(__file__).parent
TRIP = """
[[mission.trip]]
name = "{name}"
action = "{action}"
target = [{x}, {y}]
{more}
"""
"""A trip of a missions file."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """An app, and the missions that its drones shall fly."""

    app: str
    missions: str
    fleet: str
    event: str = ""
    """What it is told of while it flies; empty: of nothing."""

    def write(self, folder: Path) -> Mapping[str, Path]:
        """Write both files, and return where they are."""
        files = {"missions": folder / "missions.toml", "fleet": folder / "fleet.toml"}
        files["missions"].write_text(self.missions)
        files["fleet"].write_text(self.fleet)
        return files


def plan(name: str, app: str = "", missions: str | None = None, event: str = "") -> Plan:
    """Return the plan of a folder; `missions`: others than its own."""
    folder = HERE / "plans" / name
    text = (folder / "missions.toml").read_text() if missions is None else missions
    fleet = (folder / "fleet.toml").read_text()
    return Plan(app=app or name, missions=text, fleet=fleet, event=event)


def source_of(app: str, hooks: str, folder: Path) -> Path:
    """Compile an app of ours with its hooks; return the folder that its package is imported from."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "app.pluto").write_text((HERE / f"{app}.pluto").read_text())
    (folder / "hooks.py").write_text(hooks)
    return compiled_file(folder / "app.pluto", folder / "package") / "src"


EXAMPLES = ("drugs_distribution", "drugs_distribution_retry", "warehouse_item_finder")
PLANS = tuple(map(plan, EXAMPLES))
