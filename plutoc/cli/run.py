"""`run` and `test`: an app is compiled into a temporary folder, and called as its user would."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from plutoc.check.model import Checked
from plutoc.cli.endings import UsageError
from plutoc.cli.files import read_app
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import compile_source
from plutoc.emit.errors import place_of
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.foreign_code import Terminated
from plutoc.project.hooks import default_folder, find_hooks
from plutoc.project.package import FLEET, MISSIONS, called, with_own_code
from plutoc.project.reading import shown
from plutoc.source import Source
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable

TRIALS = "pluto_fleet.trials"


def run(options: Options) -> int:
    """Simulate an app's missions, and end as the simulation does."""
    source = read_app(options.file)
    missions = _beside(options.file, MISSIONS, options.missions)
    if missions is None:
        raise UsageError(f"there is no {MISSIONS} beside {shown(options.file)}: use --missions")
    fleet = _fleet_for(options)
    with _compiled(options.file, source) as (path, app):
        arguments = ["simulate", os.fspath(missions)]
        arguments += ["--fleet", os.fspath(fleet)] if fleet else []
        arguments += _flags(options, "seed", "fail", "runs", "until")
        return _call(path, app, arguments)


def test(options: Options) -> int:
    """Try an app, and end as the trial does."""
    if find_spec("pluto_fleet") is None:
        raise UsageError("test needs pluto-fleet, the library that flies: pip install pluto-fleet")
    fleet = _fleet_for(options)
    with _compiled(options.file, read_app(options.file)) as (path, app):
        arguments = ["--fleet", os.fspath(fleet)] if fleet else []
        arguments += ["--missions", os.fspath(options.missions)] if options.missions else []
        arguments += _flags(options, "seeds", "seed", "strike", "weather")
        return _call(path, TRIALS, [app, "--file", os.fspath(options.file), *arguments])


def _flags(options: Options, *names: str) -> list[str]:
    """Return the flags of these names that were given, and `--json` if it was."""
    values = ((name, getattr(options, name)) for name in names)
    given = [f"--{name}={value}" for name, value in values if value is not None]
    return [*given, "--json"] if options.json else given


@contextmanager
def _compiled(file: Path, source: Source) -> Iterator[tuple[Path, str]]:
    """Compile an app into a folder for as long as this lasts; give its modules' folder, and its name."""

    def hooks(checked: Checked) -> Source | None:
        return find_hooks(checked.graph, file, default_folder(file, checked.graph))

    compiled = compile_source(source, source_name=file.name, find_hooks=hooks)
    say(compiled.warnings)
    package = with_own_code(compiled, file)
    with TemporaryDirectory(prefix="pluto-") as folder:
        try:
            write(compare(package, Path(folder), place_of(compiled.checked.graph)))
        except CannotWrite as error:
            raise UsageError(f"the app cannot be compiled there: {printable(str(error))}") from None
        yield Path(folder) / "src", package.name


def _beside(file: Path, name: str, given: Path | None) -> Path | None:
    """Return what is named, else what is there: a link that leads nowhere, too, as it is told then."""
    beside = file.parent / name
    return given or (beside if os.path.lexists(beside) else None)


def _fleet_for(options: Options) -> Path | None:
    """Return the fleet file that is named, else the one beside the missions, else beside the app.

    Where the missions are named and the fleet is not, it is said which one is taken.
    """
    if options.fleet is not None or options.missions is None:
        return _beside(options.file, FLEET, options.fleet)
    for what, file in (("missions", options.missions), ("app", options.file)):
        fleet = _beside(file, FLEET, None)
        if fleet is not None:
            output.tell(f"fleet: {shown(fleet)}, beside the {what}; or name one: --fleet")
            return fleet
    return None


def _call(path: Path, module: str, arguments: list[str]) -> int:
    """Call a module of the package as its user would, and return the exit code."""
    command, environment = called(path, module, arguments)
    output.flush()
    with subprocess.Popen(command, env=environment) as child:
        while True:
            try:
                code = child.wait()
                break
            except KeyboardInterrupt:
                continue  # the terminal told the child, too: it ends in its own way
            except Terminated:
                child.terminate()  # the child was not told
                raise
    return code if code >= 0 else 128 - code
