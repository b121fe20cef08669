"""Blocks for surveys: what a package of another author's looks like."""

from .grid_scan import GRID_SCAN

BLOCKS = (GRID_SCAN,)
