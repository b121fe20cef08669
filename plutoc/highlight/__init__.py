"""Colours for sources: one table of rules, for editors (TextMate) and for pages (Pygments)."""
