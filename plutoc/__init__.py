"""The Pluto compiler: from a graph of blocks to a package that flies drones."""

__version__ = "0.1.0"  # here, not in pyproject.toml: to look it up where it is installed is slow
