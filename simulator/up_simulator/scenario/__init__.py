"""Scenarios: flights that are written down in YAML, flown, logged and judged."""
