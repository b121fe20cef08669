"""How contenders are measured: in turns, each in a process of its own, and what is said of it."""
