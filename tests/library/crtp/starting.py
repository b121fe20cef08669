"""How simulated drones are started where no app does it."""

from __future__ import annotations

import sys
from pathlib import Path

import pluto_fleet

_RUNTIME = Path(pluto_fleet.__file__).parents[1]
_PROGRAM = f"""
import sys
sys.path.insert(0, {str(_RUNTIME)!r})
from pluto_fleet.crtp.process import main
sys.exit(main(sys.argv[1:]))
"""

COMMAND = [sys.executable, "-c", _PROGRAM]
"""What starts the process; its folder is added."""
