"""One plan: what is promised of it, and one flight of it with simulated Crazyflies."""

from __future__ import annotations

import json
import os
from pathlib import Path

from tests.flights_crazyflie.flight import Flight
from tests.prediction.plans import Plan
from tests.prediction.record import Flown, Promise

LONGEST = 1800.0
"""Seconds that no flight takes."""


def promise(
    plan: Plan, source: Path, folder: Path, seeds: int, kind: type[Flight] = Flight
) -> Promise:
    """Simulate a plan with many seeds, without spread, and as a dry run."""
    flight = prepared(plan, source, folder, kind)
    runs = json.loads(_said(flight, "simulate", "--runs", str(seeds), "--json"))["summary"]
    makespan, battery = runs["makespan_s"], runs["battery_level"]
    if makespan is None:
        raise AssertionError("no simulation has completed it")
    return Promise(
        plan=plan.name,
        drones=plan.drones,
        p5=makespan["p5"],
        median=makespan["median"],
        p95=makespan["p95"],
        battery=battery["median"],
        flights=runs["attempts"]["median"],
        exact=_outcome(_said(flight, "simulate", "--no-spread")),
        dry_run=_outcome(_said(flight, "fly", kind.flag, str(plan.drones), "--dry-run")),
    )


def fly(plan: Plan, source: Path, folder: Path) -> Flown:
    """Fly a plan in real time to its end."""
    flight = prepared(plan, source, folder)
    try:
        flight.start()
        return came_of(plan, flight, flight.see_through(LONGEST))
    finally:
        flight.end()


def came_of(plan: Plan, flight: Flight, code: int) -> Flown:
    """Return what came of a flight that has ended with this exit code."""
    events = flight.events
    levels = [event["battery"] for event in events if isinstance(event.get("battery"), float)]
    kinds = [event["event"] for event in events]
    ends = [event["t"] for event in events if event["event"] == "mission.ended"]
    began = next((event["t"] for event in events if event["event"] == "brain.began"), None)
    if began is None:
        raise AssertionError(f"it was not flown:\n{flight.told}")
    return Flown(
        plan=plan.name,
        code=code,
        makespan=max(ends, default=began) - began,
        began=began,
        battery=min(levels, default=1.0),
        flights=kinds.count("trip.launched"),
        failed=kinds.count("trip.failed"),
        load=os.getloadavg()[0],
    )


def prepared(plan: Plan, source: Path, folder: Path, kind: type[Flight] = Flight) -> Flight:
    """Write a plan's files into a new folder."""
    plan.write(folder)
    return kind(app=plan.app, source=source, folder=folder, drones=plan.drones)


def _said(flight: Flight, command: str, *flags: str) -> str:
    """Return what a command says about the plan, of which a mission may fail."""
    done = flight.run(command, *flight.files, *flags)
    if done.code not in (0, 1):
        raise AssertionError(f"{command} ended with {done.code}:\n{done.err}")
    return done.out


def _outcome(said: str) -> str:
    """Return the duration of the line that says what a simulation has come to; nothing if a mission failed."""
    lines = (line for line in said.splitlines() if " completed in " in line)
    return next(lines, "").partition(" completed in ")[2]
