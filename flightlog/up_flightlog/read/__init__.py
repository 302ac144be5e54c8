"""Reads the files of a flight as far as they are intact."""
