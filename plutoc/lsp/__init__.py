"""`plutoc lsp`: what the service answers, in the words of the Language Server Protocol."""
