"""Flying an app for real: begun, recorded, commanded, recovered."""
