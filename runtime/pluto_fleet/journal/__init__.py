"""The journal: every transition of a running app, durable before it has an effect outside."""
