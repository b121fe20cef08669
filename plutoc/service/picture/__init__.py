"""An app as an editor draws it: blocks with places, edges with statuses, forms, the palette."""
