"""Missions and fences: what ground and aircraft exchange, and the files of ground stations."""
