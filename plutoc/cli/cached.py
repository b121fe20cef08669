"""An app in the user's cache, compiled and ready to be called."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

from plutoc.cache import cache_folder
from plutoc.check.model import Checked
from plutoc.cli.endings import Unusable
from plutoc.cli.files import default_folder, find_hooks, hooks_path, read_module, shown
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import Compiled, compile_source
from plutoc.emit.errors import place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.package import Package
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.source import Source
from plutoc.terminated import Terminated
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable

FLEET = "fleet.toml"


@contextmanager
def in_cache(file: Path, source: Source) -> Iterator[tuple[Path, str]]:
    """Give the folder of an app's modules, and the app's name."""

    def hooks(checked: Checked) -> Source | None:
        return find_hooks(checked, file, default_folder(file, checked))

    compiled = compile_source(source, source_name=file.name, find_hooks=hooks)
    say(compiled.warnings)
    package = _with_own_code(compiled, file)
    with _cache(file, package) as folder:
        try:
            write(compare(package, folder, place_of(compiled.checked.graph), force=True))
        except CannotWrite as error:
            raise Unusable(f"the cache cannot be written: {printable(str(error))}") from None
        yield folder / "src", package.name


def beside(file: Path, name: str, given: Path | None) -> Path | None:
    """Return what is named, else what is there: a link that leads nowhere, too, as it is told then."""
    beside = file.parent / name
    return given or (beside if os.path.lexists(beside) else None)


def fleet_for(options: Options) -> Path | None:
    """Return the fleet file that is named, else the one beside the missions, else beside the app.

    Where the missions are named and the fleet is not, it is said which one is taken.
    """
    if options.fleet is not None or options.missions is None:
        return beside(options.file, FLEET, options.fleet)
    for what, file in (("missions", options.missions), ("app", options.file)):
        fleet = beside(file, FLEET, None)
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


@contextmanager
def _cache(file: Path, package: Package) -> Iterator[Path]:
    """Give the folder in the user's cache that belongs to an app, else a temporary one."""
    facts = "\0".join([os.fspath(file.resolve()), *package.owned])
    name = f"{package.name}-{sha256(os.fsencode(facts)).hexdigest()[:16]}"
    cache = cache_folder()
    if cache is not None:
        yield cache / "run" / name
    else:
        with TemporaryDirectory(prefix="pluto-") as temporary:
            yield Path(temporary) / name


def call(path: Path, module: str, arguments: list[str]) -> int:
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
                child.terminate()  # nobody told the child
                raise
    return code if code >= 0 else 128 - code
