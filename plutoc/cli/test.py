"""`test`: compile an app into a cache, and try it under everything that can go wrong."""

from __future__ import annotations

import os

from plutoc.cli.cached import call, fleet_for, in_cache
from plutoc.cli.files import read_app
from plutoc.cli.options import Options

TESTING = "_runtime.testing"
MODULES = (f"plutoc{TESTING}", f"plutoc{TESTING}.__main__")


def test(options: Options) -> int:
    """Try an app, and end as the trial does."""
    fleet = fleet_for(options)
    with in_cache(options.file, read_app(options.file), MODULES) as (path, app):
        arguments = ["--fleet", os.fspath(fleet)] if fleet else []
        arguments += ["--missions", os.fspath(options.missions)] if options.missions else []
        for flag in ("seeds", "seed", "strike", "weather"):
            value = getattr(options, flag)
            arguments += [f"--{flag}={value}"] if value is not None else []
        arguments += ["--json"] if options.json else []
        return call(path, f"{app}.{TESTING}", ["--file", os.fspath(options.file), *arguments])
