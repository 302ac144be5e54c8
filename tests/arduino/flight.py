"""The compiled firmware on the bench, with a pilot's receiver, an IMU and a Raspberry Pi's line."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from tests.arduino.rig.firmware import make_rig
from tests.support.firmware import build_firmware
from up.commands.board_schema import STATUS, BoardStatus
from up.protocols.checked_framing import cobs_decode, crc16
from up_rig.imu import motion_at
from up_simulator.firmware.wire import checked_frame

LOW, MIDDLE, HIGH = 1000, 1500, 2000
BOOT_US = 1_400_000
FRAME_US = 20_000
ARMED, AUTO, RECEIVER, IMU, FAILSAFE, BIAS_FROM_EEPROM, GAINS_KEPT, HEARD = (
    1 << bit for bit in range(8)
)


@dataclass(frozen=True)
class Message:
    """One message of the firmware: type, payload, sequence, and the cycle of its last bit."""

    type: str
    payload: bytes
    sequence: int
    cycle: int


class Flight:
    """A booted firmware: sticks centred, throttle low, AUX1 as given, still and level.

    The tests read servo pulses, bytes of the line, EEPROM. ``may_be_cut`` is for tests that reset
    the firmware: a frame cut by the reset does not count as broken.
    """

    def __init__(self, *options, aux1=LOW, boots=True, receiver=True, **more):
        more.setdefault("is_measuring", False)
        self.rig = make_rig(build_firmware(*options), **more)
        self.rig.imu.noise_deg_s, self.rig.imu.noise_m_s2 = 0.05, 0.05
        self.rig.receiver.sticks(aux1=aux1, aux2=LOW)
        self.sequence = 0
        self.messages = []
        self._heard = b""
        self.may_be_cut = False
        if receiver:
            self.rig.receiver.start()
        if boots:
            self.run(BOOT_US)

    def run(self, duration_us):
        """Run on, keeping every whole message of checked framing."""
        self.rig.run_us(duration_us)
        for each in self.rig.serial.read_stamped():
            if each.value:
                self._heard += bytes((each.value,))
            elif self._heard:
                frame, self._heard = cobs_decode(self._heard), b""
                if self.may_be_cut and (frame is None or crc16(frame) != 0):
                    self.may_be_cut = False
                    continue
                assert frame is not None and len(frame) >= 4, "the firmware sent a broken frame"
                assert crc16(frame) == 0, "the firmware sent a frame with a wrong CRC"
                self.messages.append(Message(chr(frame[1]), frame[2:-2], frame[0], each.cycle))

    def run_ms(self, duration_ms):
        self.run(duration_ms * 1000)

    def sticks(self, wait_ms=100, **widths):
        """Move sticks and switches and let them be seen."""
        self.rig.receiver.sticks(**widths)
        self.run_ms(wait_ms)

    def send(self, letter, payload=b""):
        """Put one Command on the line; returns its sequence."""
        sequence = self.sequence
        self.rig.serial.write(checked_frame(sequence, letter, payload))
        self.sequence = (sequence + 1) % 256
        return sequence

    def ask(self, letter, payload=b"", wait_ms=40):
        """Send a Command and return its answer: ``K``, a reason of ``!``, or the payload asked."""
        del self.messages[:]
        sequence = self.send(letter, payload)
        self.run_ms(wait_ms)
        for each in self.messages:
            if each.type == "K" and each.payload == bytes((ord(letter), sequence)):
                return "K"
            if each.type == "!" and each.payload[:2] == bytes((ord(letter), sequence)):
                return each.payload[2]
            if each.type == {"c": "C"}.get(letter, letter):
                return each.payload
        return None

    def newest(self, letter):
        """Return the newest message of a type, running on until one comes."""
        del self.messages[:]
        for _ in range(60):
            self.run_ms(10)
            found = [each for each in self.messages if each.type == letter]
            if found:
                return found[-1]
        raise AssertionError(f"no {letter} came within 600 ms")

    def status(self):
        """Return the newest status, requested by a Start Command if necessary."""
        self.send("s")
        return BoardStatus(*STATUS.unpack(self.newest("x").payload))

    def mode(self):
        """Return the mode letter that `m` answers."""
        return self.ask("m").decode()

    def attitude(self):
        """Return roll, pitch and yaw (deg) of the newest `O`, and the rates (deg/s)."""
        self.send("s")
        _, yaw, pitch, roll, *rates = struct.unpack(">H6f", self.newest("O").payload)
        return roll, pitch, yaw, *reversed(rates)

    def orientation_sequence(self):
        """Return the sequence of the newest `O`."""
        return struct.unpack(">H", self.newest("O").payload[:2])[0]

    def servo_us(self, channel, wait_ms=60):
        """Return the width of a channel's newest pulse, after a while."""
        self.rig.servo.clear()
        self.run_ms(wait_ms)
        newest = self.rig.servo.newest_us(channel)
        assert newest is not None, f"{channel} gets no pulses"
        return newest

    def widths_us(self, channel, since_cycle=0):
        """Return the widths of a channel's pulses that rose after a cycle."""
        pulses = self.rig.servo.pulses(channel)
        return [each.width_us for each in pulses if each.rise_cycle > since_cycle]

    def arm(self):
        """Arm by AUX2 as a pilot does."""
        self.sticks(400, throttle=LOW, aux2=LOW)
        self.sticks(400, aux2=HIGH)
        assert self.status().is_armed

    def tilt(self, roll_deg, pitch_deg=0.0, seconds=0.5):
        """Turn the aircraft to an attitude and hold it there."""
        roll, pitch, *_ = self.attitude()
        start_s = self.rig.now_us / 1e6
        rates = ((roll_deg - roll) / seconds, (pitch_deg - pitch) / seconds, 0.0)

        def motion(time_s):
            part = (time_s - start_s) / seconds
            if part >= 1:
                return motion_at(roll_deg, pitch_deg)
            at = (roll + (roll_deg - roll) * part, pitch + (pitch_deg - pitch) * part)
            return motion_at(*at, rates)

        self.rig.imu.motion = motion
        self.run(seconds * 1e6 + 100_000)
