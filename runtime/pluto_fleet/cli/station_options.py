"""The flags of `serve`."""

from __future__ import annotations

from argparse import SUPPRESS, ArgumentParser
from pathlib import Path

from ..arguments import whole_number

HOST, PORT = "127.0.0.1", 8765


def add_station(parser: ArgumentParser) -> None:
    """Add what only `serve` takes."""
    parser.add_argument(
        "--missions",
        dest="plan",
        metavar="M.toml",
        type=Path,
        help="the plan that an empty station begins with",
    )
    parser.add_argument(
        "--host",
        metavar="H",
        default=HOST,
        help=f"the address to listen at; default {HOST}: this computer alone. Any other needs the"
        " token that is printed",
    )
    parser.add_argument(
        "--port", metavar="N", type=whole_number(0, 65_535), default=PORT, help=f"default {PORT}; 0: any that is free"
    )
    parser.add_argument(
        "--name",
        dest="names",
        metavar="HOST",
        action="append",
        default=[],
        help="another name that browsers may use for it, such as that of a proxy before it",
    )
    parser.add_argument(
        "--folder",
        metavar="D",
        type=Path,
        help="where plan and journals are kept; default: the user's own folder",
    )
    parser.add_argument("--open", action="store_true", help="open it in a browser")
    parser.add_argument("--going-on", action="store_true", help=SUPPRESS)  # after a crash
