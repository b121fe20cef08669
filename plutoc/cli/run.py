"""`run`: compile an app into a cache and simulate its missions at once."""

from __future__ import annotations

import os

from plutoc.cli.cached import beside, call, fleet_for, in_cache
from plutoc.cli.endings import Unusable
from plutoc.cli.files import read_app, shown
from plutoc.cli.options import Options

MISSIONS = "missions.toml"


def run(options: Options) -> int:
    """Simulate an app's missions, and end as the simulation does."""
    source = read_app(options.file)
    missions = beside(options.file, MISSIONS, options.missions)
    if missions is None:
        raise Unusable(f"there is no {MISSIONS} beside {shown(options.file)}: use --missions")
    fleet = fleet_for(options)
    with in_cache(options.file, source) as (path, app):
        arguments = ["simulate", os.fspath(missions)]
        arguments += ["--fleet", os.fspath(fleet)] if fleet else []
        for flag in ("seed", "fail", "runs", "until"):
            value = getattr(options, flag)
            arguments += [f"--{flag}={value}"] if value is not None else []
        arguments += ["--json"] if options.json else []
        return call(path, app, arguments)
