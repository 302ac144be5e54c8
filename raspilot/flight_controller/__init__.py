"""Raspilot's own flight controller: every file here is loaded."""
