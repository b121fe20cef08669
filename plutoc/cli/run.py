"""`run` and `test`: an app is compiled into a temporary folder, and called as its user would."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from plutoc.check.model import Checked
from plutoc.cli.endings import UsageError
from plutoc.cli.files import default_folder, find_hooks, hooks_path, read_app, read_module, shown
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import Compiled, compile_source
from plutoc.emit.errors import place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.package import Package
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.foreign_code import Terminated
from plutoc.source import Source
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable

FLEET = "fleet.toml"
MISSIONS = "missions.toml"
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
        return find_hooks(checked, file, default_folder(file, checked))

    compiled = compile_source(source, source_name=file.name, find_hooks=hooks)
    say(compiled.warnings)
    package = _with_own_code(compiled, file)
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


def _with_own_code(compiled: Compiled, file: Path) -> Package:
    """Return a package of which every file is ours to write, the developer's code included."""
    package, path = compiled.package, hooks_path(compiled.checked)
    texts = {**package.once, **_own_modules(default_folder(file, compiled.checked), package)}
    if compiled.hooks is not None:
        texts[path] = compiled.hooks.text
    return replace(package, owned={**package.owned, **texts}, once={})


def _own_modules(folder: Path, package: Package) -> dict[str, str]:
    """Return the modules that the developer put beside the hooks.py of a generated package."""
    app = folder / "src" / package.name
    if not (folder / LOCK).is_file() or not app.is_dir():
        return {}
    paths = {path.relative_to(folder).as_posix(): path for path in sorted(app.rglob("*.py"))}
    return {
        name: read_module(path).text
        for name, path in paths.items()
        if name not in (*package.owned, *package.once) and "_runtime" not in path.parts
    }


def _call(path: Path, module: str, arguments: list[str]) -> int:
    """Call a module of the package as its user would, and return the exit code."""
    before = os.environ.get("PYTHONPATH")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(path), before]))}
    output.flush()
    # -P: nothing of the folder that we are in counts, the generated package least of all.
    command = [sys.executable, "-P", "-m", module, *arguments]
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
