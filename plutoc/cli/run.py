"""`run`: compile an app into a cache and simulate its missions at once."""

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
from plutoc.cli.endings import Terminated, Unusable
from plutoc.cli.files import default_folder, find_hooks, hooks_path, read_app, read_module, shown
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import Compiled, compile_source
from plutoc.emit.errors import place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.package import Package
from plutoc.emit.write import CannotWrite, compare, write
from plutoc.source import Source
from plutoc_runtime.cli import output
from plutoc_runtime.words import printable

MISSIONS, FLEET = "missions.toml", "fleet.toml"


def run(options: Options) -> int:
    """Simulate an app's missions, and end as the simulation does."""
    source = read_app(options.file)
    missions = _beside(options.file, MISSIONS, options.missions)
    if missions is None:
        raise Unusable(f"there is no {MISSIONS} beside {shown(options.file)}: use --missions")
    fleet = _beside(options.file, FLEET, options.fleet)

    def hooks(checked: Checked) -> Source | None:
        return find_hooks(checked, options.file, default_folder(options.file, checked))

    compiled = compile_source(source, source_name=options.file.name, find_hooks=hooks)
    say(compiled.warnings)
    package = _with_own_code(compiled, options.file)
    with _cache(options.file, package) as folder:
        try:
            write(compare(package, folder, place_of(compiled.checked.graph), force=True))
        except CannotWrite as error:
            raise Unusable(f"the cache cannot be written: {printable(str(error))}") from None
        arguments = ["simulate", os.fspath(missions)]
        arguments += ["--fleet", os.fspath(fleet)] if fleet else []
        arguments += ["--seed", str(options.seed)] if options.seed is not None else []
        arguments += ["--json"] if options.json else []
        return _simulate(folder / "src", package.name, arguments)


def _beside(file: Path, name: str, given: Path | None) -> Path | None:
    beside = file.parent / name
    return given or (beside if beside.exists() else None)


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


def _simulate(path: Path, app: str, arguments: list[str]) -> int:
    """Call the app as its user would, and return its exit code."""
    before = os.environ.get("PYTHONPATH")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(path), before]))}
    output.flush()
    # -P: nothing of the folder that we are in counts, the generated package least of all.
    command = [sys.executable, "-P", "-m", app, *arguments]
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
