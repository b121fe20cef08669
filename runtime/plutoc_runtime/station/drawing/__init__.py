"""How the app's graph is laid out on a page: boxes in rows that turn like a road, right-angled ways."""
