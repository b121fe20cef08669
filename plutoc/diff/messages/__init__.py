"""What is said of changes: one constructor for each kind of change, all prose in this folder.

A sentence says from the view of a mission what is so now, and what was so before. It begins small
and ends without a full stop, as those of the diagnostics do.
"""
