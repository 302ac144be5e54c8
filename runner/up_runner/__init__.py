"""The runner: starts and supervises Raspilot instances."""
