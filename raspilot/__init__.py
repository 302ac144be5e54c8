"""Raspilot: the autopilot application on Up."""
