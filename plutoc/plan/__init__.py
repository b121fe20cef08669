"""From checked graph to plan: structured control flow, one coroutine per mission."""
