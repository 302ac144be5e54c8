"""A foreign flight controller in place of the Arduino: Betaflight's own simulator, SITL."""
