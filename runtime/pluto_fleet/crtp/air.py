"""What is between a drone and whoever talks to it: packets that come late, or not at all."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random


@dataclass(slots=True)
class Air:
    """The way to one drone and back."""

    random: Random
    loss: float = 0.0
    """The share of packets that is lost, each way."""
    latency: float = 0.0
    """Seconds that a packet takes, each way."""
    silent: bool = False
    """Whether nothing gets through at all."""

    def loses(self) -> bool:
        """Whether the next packet is lost."""
        return self.silent or (self.loss > 0.0 and self.random.random() < self.loss)
