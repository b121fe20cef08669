"""The firmware's supervisor: arming, and locking the motors."""

from __future__ import annotations

from dataclasses import dataclass

_HYSTERESIS = 2.0
"""Seconds after the motors have stopped within which it still counts as flying."""
LANDED, _UNUSED = 3.0, 30.0
"""Seconds after which an armed drone is disarmed: after a landing, or without a take-off."""
_RESETS = 0.12
"""Seconds after a disarming within which it cannot be armed: three cycles of its supervisor."""
_NOTICES = 0.05
"""Seconds until it notices turning motors: a take-off just before the disarming is cancelled."""
_LEVEL, _LOCK = 0.5, 2.0
"""Seconds without a new low-level setpoint, after which it levels out, and then locks."""
_FED = 1.0
"""The time-out of the emergency watchdog, once it was fed, in seconds."""
_NEVER = -1e9


@dataclass(slots=True)
class Supervisor:
    """The state of one drone; times are handed in."""

    auto_arm: bool = False
    armed: bool = False
    locked: bool = False
    faulty: bool = False
    """Whether one of its decks has a fault."""
    crashed: bool = False
    tumbled: bool = False
    flying: bool = False
    setpoint_at: float | None = None
    """The time of the last low-level setpoint in effect, or None."""
    fed_at: float | None = None
    """When the emergency watchdog was last fed."""
    landed: float = LANDED
    """Seconds on the ground after which it is disarmed."""
    _turns_since: float | None = None
    _resets_until: float = _NEVER
    _resets: bool = False
    _thrust_at: float = _NEVER
    _armed_at: float = _NEVER
    _warned: bool = False

    @property
    def can_fly(self) -> bool:
        return self.armed and not (self.locked or self.crashed or self.tumbled)

    @property
    def can_arm(self) -> bool:
        blocked = self.locked or self.crashed or self.tumbled or self.faulty
        return not (self.armed or self._resets or blocked)

    def arm(self, on: bool, now: float) -> bool:
        """Arm or disarm; return whether that was done."""
        if on and not self.armed:
            if not self.can_arm:
                return False
            self.armed, self._armed_at, self._thrust_at = True, now, _NEVER
        elif not on and self.armed:
            if self.flying:
                return False
            self._reset(now)
        return True

    def _reset(self, now: float) -> None:
        """Disarm it; for a moment it cannot be armed."""
        self.armed, self._resets, self._resets_until = False, True, now + _RESETS

    def recover(self) -> bool:
        """Leave the crashed state, if it stands upright; return whether that was done."""
        if self.crashed and not self.tumbled:
            self.crashed = self.armed = False
        return not self.crashed

    def lock(self) -> None:
        self.locked, self.armed = True, False

    def restart(self) -> None:
        self.armed = self.locked = self.crashed = self.flying = False
        self.faulty = self._warned = self._resets = False
        self._turns_since = None
        self.setpoint_at = self.fed_at = None
        self._thrust_at = self._armed_at = _NEVER

    def step(self, now: float, *, thrust: bool, tumbled: bool) -> None:
        self._turns_since = (self._turns_since or now) if thrust else None
        if self._turns_since is not None and now - self._turns_since >= _NOTICES:
            self._thrust_at = now
        self.tumbled = tumbled
        self.flying = now - self._thrust_at < _HYSTERESIS and not (self.locked or self.crashed)
        if tumbled and (self.flying or self.armed):
            self.crashed, self.armed, self.flying = True, False, False
        self._watch(now)
        self._resets = self._resets and now < self._resets_until
        if self.armed and not self.flying:
            since = max(self._armed_at, self._thrust_at)
            limit = _UNUSED if self._thrust_at == _NEVER else _HYSTERESIS + self.landed
            if self.faulty or now - since >= limit:
                self._reset(now)
        if self.auto_arm and self.can_arm:
            self.arm(True, now)

    def _watch(self, now: float) -> None:
        """Lock if setpoints, the watchdog's feeding, or a deck have failed in the air."""
        if self.faulty and self.flying:
            self.lock()
        age = 0.0 if self.setpoint_at is None else now - self.setpoint_at
        self._warned = age > _LEVEL and (self._warned or self.flying or self.crashed)
        if self._warned and age > _LOCK:
            self.lock()
        if age > _LOCK:
            self.setpoint_at = None
        if self.fed_at is not None and now - self.fed_at > _FED:
            self.lock()

    def info(self, *, high_level: bool, finished: bool, planner_off: bool = False) -> int:
        bits = (
            self.can_arm,
            self.armed,
            self.auto_arm,
            self.can_fly,
            self.flying,
            self.tumbled,
            self.locked,
            self.crashed,
            high_level,
            finished,
            planner_off,
            self.faulty,
        )
        return sum(1 << place for place, bit in enumerate(bits) if bit)
