"""Raspilot's own modules: every file here is loaded."""
