"""The plan that people draw: checked where it is wrong, kept with every change."""
