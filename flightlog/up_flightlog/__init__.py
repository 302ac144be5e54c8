"""Reads recorded flights: findings, report, plots, exports, and `up log`."""
