"""A flight's pictures as they were taken, in one ZIP file with a table of them."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

from ...shared.domain.errors import BadInput
from .pictures import picture
from .tables import cells, csv_text, picture_name

if TYPE_CHECKING:
    from .flights import FlightResults

INDEX, MISSING = "results.csv", "missing.txt"


def write_archive(flight: FlightResults, folder: Path) -> Path:
    """Write the archive into a new file of a folder, and return it; whoever asked deletes it.

    It has `results.csv`, whose column `picture` names the files beside it, and `missing.txt` with a
    sentence for each picture that could not be read, if there are any.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(suffix=".zip", dir=folder)
    missing = []
    with open(descriptor, "wb") as file, ZipFile(file, "w", ZIP_STORED) as archive:
        archive.writestr(INDEX, csv_text(cells(flight)), compress_type=ZIP_DEFLATED)
        for number, named in flight.pictures.items():
            try:
                content, _ = picture(flight, number)
            except BadInput as why:
                missing.append(f"{why}\n")
            else:
                archive.writestr(picture_name(number, named), content)
        if missing:
            archive.writestr(MISSING, "".join(missing))
    return Path(name)
