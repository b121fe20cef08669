"""Places, ways and areas in degrees, as other programs draw them: GeoJSON, KML, plans of ground stations, lists."""
