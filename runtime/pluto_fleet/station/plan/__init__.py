"""The plan that users draw: validated, and stored with every change."""
