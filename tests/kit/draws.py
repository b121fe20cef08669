"""How many cases are drawn: a few by default, and many in the long tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest


def draws(few: int, many: int) -> Sequence[Any]:
    """Return seeds for `parametrize`: the first few are always taken, all others in the long tests."""
    long = [pytest.param(seed, marks=pytest.mark.long) for seed in range(few, many)]
    return [*range(few), *long]
