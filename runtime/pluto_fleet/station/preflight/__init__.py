"""What a Start would do, before it does it: forecast by many runs in virtual time, and rehearsed."""
