"""What must hold of every run, and the runs in which everything goes wrong that can."""
