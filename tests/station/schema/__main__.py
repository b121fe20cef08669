"""`python -m tests.station.schema`: write what is made from the types of the wire."""

from .made import made

for file, text in made().items():
    file.write_text(text, encoding="utf-8")
