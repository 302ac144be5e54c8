"""Sensors at the I2C bus of the Raspberry Pi, for Up."""
