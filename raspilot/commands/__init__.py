"""Raspilot's own commands: every file here is loaded."""
