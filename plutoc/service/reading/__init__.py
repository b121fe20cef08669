"""What an editor tells of a text: hover, outline, hints on arrows, fixes."""
