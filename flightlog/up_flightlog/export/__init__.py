"""Exports of flights to other programs' formats: tables, tracks."""
