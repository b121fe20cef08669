"""The station's web server: requests, access control, and updates of pages."""
