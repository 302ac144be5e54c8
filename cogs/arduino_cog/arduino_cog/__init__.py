"""The Arduino as a flight controller and as the board of servos and receiver (thesis 4.2.4)."""
