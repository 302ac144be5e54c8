"""Raspilot's own flight modes: every file here is loaded."""
