"""A flight that lies still and records its servos."""

from up_simulator.aircraft.flight import NEUTRAL, FlightState


class StillFlight:
    def __init__(self):
        self.state = FlightState(
            0.0, 3.25, -5.5, 10.5, 0.5, -0.25, 1.0, 50.0, 14.5, 650.0, 400.0, 9.0, 10.0, 8.5
        )
        self.servos = NEUTRAL

    def set_servos(self, pulses_us):
        self.servos = pulses_us

    def advance(self, duration_s):
        pass
