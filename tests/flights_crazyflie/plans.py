"""What is flown: short ways on a small floor, for these flights take the time that they take."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from shutil import copytree

from tests.kit.apps import EXAMPLES, compiled_file

Target = tuple[float, float, float]

CRUISE = 0.5
SIZE = (6.0, 6.0)
DISTRIBUTION, RETRY = "drugs_distribution", "drugs_distribution_retry"
"""Examples: one that gives up a trip that fails, and one that lets another drone fly it."""


def quick_package(into: Path, speed: float | None = 1.0, app: str = RETRY) -> Path:
    """Compile an example with drones of another speed; return the folder of its sources."""
    copytree(EXAMPLES / app, into, dirs_exist_ok=True)
    if speed is not None:
        text = (into / "app.pluto").read_text()
        (into / "app.pluto").write_text(_CATEGORY.sub(partial(_as_fast, f"{speed:g} m/s"), text))
    return compiled_file(into / "app.pluto", into / app) / "src"


_CATEGORY = re.compile(r"(?m)^  category (\w+)(?:\((.*)\))? can")


def _as_fast(speed: str, category: re.Match[str]) -> str:
    given = (category[2] or "").split(", ")
    others = [one for one in given if one and not one.startswith("speed:")]
    return f"  category {category[1]}({', '.join([f'speed: {speed}', *others])}) can"


def plan(name: str) -> tuple[str, str]:
    """Return the missions file and the fleet file of a plan."""
    folder = Path(__file__).parent / "plans" / name
    return (folder / "missions.toml").read_text(), (folder / "fleet.toml").read_text()


def homes(fleet: str) -> dict[str, Target]:
    """Return where the drones of a fleet file stand."""
    return {one["id"]: (*one["home"], 0.0) for one in tomllib.loads(fleet)["drone"]}


def targets(missions: str) -> Mapping[tuple[str, str], Target]:
    """Return where each trip of a missions file leads."""
    return {
        (mission["name"], trip["name"]): (*trip["target"], CRUISE)
        for mission in tomllib.loads(missions)["mission"]
        for trip in mission["trip"]
    }


def write(folder: Path, missions: str, fleet: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "missions.toml").write_text(missions)
    (folder / "fleet.toml").write_text(fleet)
