"""Telemetry and counters of the daemon for Prometheus."""
