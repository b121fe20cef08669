"""A source in canonical form: the same tokens and comments, with the blanks that belong there."""
