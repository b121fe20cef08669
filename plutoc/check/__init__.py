"""From graph to checked graph: the statuses on every edge, and forks that close at their gates."""
