"""`test`: compile an app into a cache, and try it under everything that can go wrong."""

from __future__ import annotations

import os
from importlib.util import find_spec

from plutoc.cli.cached import call, fleet_for, in_cache
from plutoc.cli.endings import Unusable
from plutoc.cli.files import read_app
from plutoc.cli.options import Options

TRIALS = "pluto_fleet.trials"


def test(options: Options) -> int:
    """Try an app, and end as the trial does."""
    if find_spec("pluto_fleet") is None:
        raise Unusable("test needs pluto-fleet, the library that flies: pip install pluto-fleet")
    fleet = fleet_for(options)
    with in_cache(options.file, read_app(options.file)) as (path, app):
        arguments = ["--fleet", os.fspath(fleet)] if fleet else []
        arguments += ["--missions", os.fspath(options.missions)] if options.missions else []
        for flag in ("seeds", "seed", "strike", "weather"):
            value = getattr(options, flag)
            arguments += [f"--{flag}={value}"] if value is not None else []
        arguments += ["--json"] if options.json else []
        return call(path, TRIALS, [app, "--file", os.fspath(options.file), *arguments])
