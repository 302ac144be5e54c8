"""The verbs below `up log`."""
