"""What a person must know of: one list of alerts for all pages."""
