"""Sensors and receivers aboard as twins, by their data sheets."""
