"""Rows of which everybody gets only those that have changed since they looked."""

from __future__ import annotations

import json
from collections.abc import Iterator


class Versions:
    """Rows by their names, each as JSON with the number of its last change."""

    def __init__(self) -> None:
        self._rows: dict[str, tuple[int, object, str]] = {}

    def put(self, name: str, row: object, number: int) -> bool:
        """Keep a row; say whether it is another than it was."""
        known = self._rows.get(name)
        if known is not None and known[1] == row:
            return False
        self._rows[name] = number, row, json.dumps(row)
        return True

    def since(self, number: int) -> Iterator[str]:
        """Yield the rows that have changed after that number."""
        return (text for changed, _, text in self._rows.values() if changed > number)
