"""One trip: its flight, its time-outs, its changes of status."""
