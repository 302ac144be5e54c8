"""Flies the owner's configuration through every failure, judges it and names what to change."""
