"""A board in virtual time, with a flight that lies still and records its servos."""

import struct

from twisted.internet.task import Clock

from tests.simulator.pi import Listener, frame
from up_simulator.board import Board
from up_simulator.flight import NEUTRAL, FlightState
from up_simulator.receiver import SOARING, Receiver, read_sticks

TICK_S = 0.005


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


class Bench:
    """The board, what it sends, and a Raspberry Pi that writes checked frames."""

    def __init__(self, sticks="", *, has_motor=False, start=True, **options):
        self.clock = Clock()
        self.clock.advance(1000.0)
        self.flight = StillFlight()
        self.listener = Listener()
        self.raw = b""
        self.said = []
        moves = read_sticks(SOARING) + read_sticks(sticks)
        self.receiver = Receiver(moves, self.clock.seconds())
        self.board = Board(
            self.flight,
            self.receiver,
            self.clock,
            self._hear,
            has_motor=has_motor,
            say=self.said.append,
            **options,
        )
        self.sequence = 0
        if start:
            self.send("s")
            self.listener.take()

    def _hear(self, data):
        self.raw += data
        if not self.board.is_thesis:
            self.listener.feed(data)

    def run(self, duration_s):
        for _ in range(round(duration_s / TICK_S)):
            self.board.tick()
            self.clock.advance(TICK_S)

    def send(self, letter, payload=b""):
        """Send one Command and return the answers that came at once."""
        self.listener.take()
        self.board.data_received(frame(self.sequence, letter, payload))
        self.sequence = (self.sequence + 1) % 256
        return self.listener.take()

    def answer(self, letter, payload=b""):
        """Send one Command and return type and payload of its only answer."""
        (message,) = self.send(letter, payload)
        return message.type, message.payload

    def confirmed(self, letter, payload=b""):
        """Send one Command and tell whether it was confirmed with its own sequence."""
        sequence = self.sequence
        return self.answer(letter, payload) == ("K", bytes([ord(letter), sequence]))

    def refused(self, letter, payload=b""):
        """Send one Command and return why it was refused, None when it was not."""
        sequence = self.sequence
        for message in self.send(letter, payload):
            if message.type == "!":
                assert message.payload[:2] == bytes([ord(letter), sequence])
                return message.payload[2]
        return None

    def newest_orientation(self):
        """Let the board send one more orientation and return its sequence."""
        self.listener.take()
        while True:
            self.run(TICK_S)
            for message in self.listener.take("O"):
                return struct.unpack(">H", message.payload[:2])[0]

    def output(self, pulses, sequence):
        return self.refused("u", struct.pack(">5H", *pulses, sequence))

    def status(self):
        self.listener.take()
        self.run(0.2)
        return self.listener.take("x")[-1].payload
