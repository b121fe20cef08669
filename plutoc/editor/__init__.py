"""`plutoc edit`: an app's graph in a browser, beside its text, which is the truth."""
