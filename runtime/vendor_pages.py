"""Copy the libraries of the station's pages out of npm: `python runtime/vendor_pages.py`, with npm on the path.

They are plain ES modules, copied as they are: an import map in `index.html` says which is which, so
that a browser loads them without a build, and no request leaves the machine.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).parent
FOLDER = HERE / "pluto_fleet" / "station" / "pages" / "vendor"

MODULES = {  # name in an import: its package, its ES module
    "preact": ("preact", "dist/preact.mjs"),
    "preact/hooks": ("preact", "hooks/dist/hooks.mjs"),
    "@preact/signals-core": ("@preact/signals-core", "dist/signals-core.mjs"),
    "@preact/signals": ("@preact/signals", "dist/signals.mjs"),
}


def file_of(name: str) -> str:
    """Return the name of a module's file: `@preact/signals` is `preact-signals.mjs`."""
    return f"{name.removeprefix('@').replace('/', '-')}.mjs"


def main() -> None:
    """Write the modules with their licences, and a list of where each came from."""
    subprocess.run(
        ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=HERE, check=True
    )
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    lines = ["# Libraries of the pages, as npm has them: `python runtime/vendor_pages.py`", ""]
    for name, (package, module) in MODULES.items():
        source = HERE / "node_modules" / package
        text = (source / module).read_text(encoding="utf-8")
        without_map = "\n".join(
            line for line in text.splitlines() if not line.startswith("//# sourceMappingURL")
        )
        (FOLDER / file_of(name)).write_text(without_map + "\n", encoding="utf-8")
        shutil.copy(source / "LICENSE", FOLDER / f"{file_of(package)[:-4]}.LICENSE.txt")
        version = json.loads((source / "package.json").read_text(encoding="utf-8"))["version"]
        lines.append(f"- `{file_of(name)}`: {package} {version}, `{module}`")
    (FOLDER / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
