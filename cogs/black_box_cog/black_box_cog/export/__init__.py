"""Flights as files of other programs: tables, tracks."""
