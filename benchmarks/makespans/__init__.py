"""Plans whose makespan is measured: by each policy, and by a routing solver's routes."""
