"""Examples as a user installs them: compiled, and with the extra `station` in one environment."""

from __future__ import annotations

import fcntl
import shutil
import sys
import venv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.kit.apps import fly_straight
from tests.release.environments import ROOT, compile_app, succeed

ALTERED = {
    "night_ward": (
        "night_round",
        {
            "app night_round": "app night_ward",
            'patient: text = "", most: float = 20': "patient: text, most: float = 20, margin: time = 10 min",
            "  action listen": "  trip has softly: bool, warmth: temperature = 20 C\n\n  action listen",
        },
    )
}
"""Apps that are an example with other words in its source."""


@dataclass(frozen=True, slots=True, kw_only=True)
class App:
    """An installed app, and the two files that its example has."""

    name: str
    program: Path
    fleet: Path
    missions: Path


def installed(names: Sequence[str], folder: Path) -> dict[str, App]:
    """Install these examples into one environment; the second caller finds it made."""
    folder.mkdir(parents=True, exist_ok=True)
    programs = folder / "venv" / "bin"
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # the other workers wait here
        if not (folder / "made").exists():
            _install(names, folder)
            (folder / "made").touch()
    return {
        name: App(
            name=name,
            program=programs / name,
            fleet=folder / name / "fleet.toml",
            missions=folder / name / "missions.toml",
        )
        for name in names
    }


def _install(names: Sequence[str], folder: Path) -> None:
    wanted = []
    for name in names:
        example, words = ALTERED.get(name, (name, {}))
        shutil.copytree(ROOT / "examples" / example, folder / name)
        source = folder / name / "app.pluto"
        text = source.read_text(encoding="utf-8")
        for old, new in words.items():
            assert old in text
            text = text.replace(old, new)
        source.write_text(text, encoding="utf-8")
        fly_straight(folder / name / "fleet.toml")
        package = compile_app(source, folder / name / "package")
        wanted.append(f"{package}[station]")
    venv.create(folder / "venv", with_pip=False)
    pip = (sys.executable, "-m", "pip", "--python", folder / "venv", "install", "--quiet")
    succeed(*pip, ROOT / "runtime", *wanted)
