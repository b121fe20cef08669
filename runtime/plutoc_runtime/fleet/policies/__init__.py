"""The allocation policies that a graph can name, one file each."""
