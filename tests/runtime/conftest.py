"""The runtime's tests: `apps.py` beside this file holds what they fly."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
