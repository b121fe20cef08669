"""A fleet that flies trips in virtual time, written by hand: what `simulate` is measured beside."""
