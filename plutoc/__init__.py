"""The Pluto compiler: from a graph of blocks to a package that flies drones."""
