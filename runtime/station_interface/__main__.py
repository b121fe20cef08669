"""`python -m station_interface`: write what is made from the types of the wire."""

from argparse import ArgumentParser

from .made import made

ArgumentParser(prog="python -m station_interface", description=__doc__).parse_args()
for file, text in made().items():
    file.write_text(text, encoding="utf-8")
