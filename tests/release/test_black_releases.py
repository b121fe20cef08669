"""What we write is the same with the oldest Black that we take and with the newest.

Their own packages are kept beside pytest's cache: only a first run waits for pip.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.compiler.emit.texts import APPS, modules_of
from tests.paths import ROOT
from tests.release.environments import succeed

RELEASES = ("24.1.0", "")
"""The last: the newest."""
GOLDEN = sorted(ROOT.glob("tests/cases/*/expected/**/*.py"))
OWN = "# fmt: off\n"
"""Below it, Black would look at nothing."""

CHANGED = """
import json, sys
import black
mode = black.Mode(line_length=100, target_versions={black.TargetVersion.PY311})
texts = json.load(sys.stdin)
json.dump([text for text in texts if black.format_str(text, mode=mode) != text], sys.stdout)
"""


@pytest.fixture(params=RELEASES, ids=lambda release: release or "newest")
def black(request: pytest.FixtureRequest) -> Path:
    """Return a folder with a release of Black, and of what it needs."""
    release: str = request.param
    name = f"black-{release or 'newest'}-py{sys.version_info[0]}.{sys.version_info[1]}"
    folder = Path(request.config.cache.mkdir(name))
    if not (folder / "installed").exists():
        wanted = f"black=={release}" if release else "black"
        target = ("--quiet", "--upgrade", "--target", str(folder))
        succeed(sys.executable, "-m", "pip", "install", *target, wanted)
        (folder / "installed").touch()
    return folder


def test_a_release_of_black_would_change_nothing(black: Path) -> None:
    """Neither of what the examples' packages hold, nor of what the tests compare."""
    golden = [path.read_text(encoding="utf-8").partition(OWN) for path in GOLDEN]
    texts = [below or whole for whole, _, below in golden]
    own = [module for app in APPS for module in modules_of(app).values()]
    done = subprocess.run(
        [sys.executable, "-c", CHANGED],
        input=json.dumps([*texts, *own]),
        env={"PYTHONPATH": str(black), "XDG_CACHE_HOME": str(black / "cache")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert len(GOLDEN) > 5
    assert json.loads(done.stdout) == []
