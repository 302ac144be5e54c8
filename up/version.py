"""The version of everything in this distribution."""

VERSION = "0.1.0"
BUILT_S = 1795392000
"""Midnight UTC of 2026-11-23, the day of this version: an earlier clock is wrong."""
