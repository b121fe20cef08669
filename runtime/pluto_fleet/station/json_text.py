"""Data as JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import isfinite


def json_text(data: object) -> str:
    """Return data as JSON in ASCII; numbers that JSON lacks become texts."""
    try:
        return json.dumps(data, separators=(",", ":"), allow_nan=False)
    except ValueError:  # a hook returned NaN or infinity
        return json.dumps(_finite(data), separators=(",", ":"), allow_nan=False)


def _finite(data: object) -> object:
    if isinstance(data, float) and not isfinite(data):
        return str(data)
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return data
