"""Being told to end: what every part that catches whatever somebody's code raises must let through."""

from __future__ import annotations


class Terminated(BaseException):
    """We were told to end, by a signal: no mistake of anybody's, so no `Exception` either."""

    def __init__(self, signal: int) -> None:
        super().__init__(signal)
        self.code = 128 + signal
