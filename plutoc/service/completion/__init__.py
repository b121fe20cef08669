"""How completions are found: what may be meant by the words around, each tried before it is offered."""
