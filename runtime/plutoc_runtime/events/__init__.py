"""Events: what happens outside of the missions, and what is made of it."""
