"""Missions and fences on the aircraft."""
