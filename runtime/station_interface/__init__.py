"""The description of the station's interface, and what is made of it: `python -m station_interface`."""
