"""What goes wrong on purpose, in the words of who reads what came of it."""

from __future__ import annotations

from collections.abc import Mapping

from .blows import Kind

ENDS: Mapping[str, str] = {
    "COMPLETED": "were completed",
    "FAILED": "failed, as they may when so much goes wrong",
    "CANCELLED": "were cancelled",
}
"""How missions end."""
WORDS: Mapping[str, str] = {
    "crash": "the app died",
    "crash-kept": "the app died before it had acted on what it had written down",
    "crash-lost": "the app died before it had written down what it was about to do",
    "freeze": "the app stood still, and went on when another had taken over",
    "rtl": "everything was stopped, and flew home",
    "land": "everything was stopped, and landed",
    "gateway": "the gateway died",
    "cut": "app and gateway lost one another",
    "report": "the end of a flight was not heard",
    "reboot": "a drone was switched off and on again",
    "fall": "a drone fell down",
    "pause": "a person paused a mission",
    "skip": "a person skipped a trip",
    "cancel": "a person cancelled a mission",
    "disk": "the disk was full",
    "failsafe": "the gateway landed everything, because the app was silent",
    "death in recovery": "the app died while it was starting anew",
    "report to nobody": "a flight ended while the app was down",
    "slow line": "a message between app and gateway came late",
    "slow radio": "a message between gateway and drone came late",
    "slow disk": "the disk was slow",
    "late wake-up": "the app woke up late",
    "clock jump": "the machine's clock was set",
    "snapshot": "the app began with a snapshot of its journal",
    "hook raising": "a hook raised an error that nobody expected",
    "hook blocking": "a hook took half a minute",
    "go on": "a person let a paused mission go on",
    "decision": "a person was asked what had become of a trip",
    "decision at rest": "a person was asked that while the app was down",
    "flight: crash": "a drone crashed",
    "flight: link": "a drone lost its link",
    "flight: battery": "a drone ran out of battery",
    "flight: action": "an action failed",
}
"""Everything of which it is counted how often it has struck."""
WRITTEN: Mapping[str, str] = {
    **{kind.value: f"--strike {kind.value}" for kind in Kind},
    "slow line": "--weather slow",
    "slow radio": "--weather radio",
    "slow disk": "--weather disk",
    "late wake-up": "--weather late",
    "clock jump": "--weather jump",
    "snapshot": "--weather snapshot",
    "hook raising": "--weather hook",
    "hook blocking": "--weather block",
    **{f"flight: {name}": f"--weather {name}" for name in ("crash", "link", "battery", "action")},
}
"""How what can be asked for is asked for."""
