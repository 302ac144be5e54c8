"""UBX, the protocol of u-blox receivers: NAV-PVT makes fixes, and the set-up asks for it."""

from collections import Counter
from collections.abc import Iterator
from typing import Any

from pyubx2 import SET, UBXMessage, UBXReader, calc_checksum

from gps_cog.fix import GpsFix

SYNC = b"\xb5b"
HEADER_BYTES, CHECK_BYTES = 6, 2
NAV_PVT, ACK, NAK = (0x01, 0x07), (0x05, 0x01), (0x05, 0x00)
SIZES = {NAV_PVT: 92, ACK: 2, NAK: 2}
"""Bytes of the payload of each message that is used."""
AIRBORNE_4G = 8
KINDS = {2: "2d", 3: "3d", 4: "3d"}
WEEK_S = 604800.0


class UbxDecoder:
    """Turns bytes into fixes; noise and damaged messages are dropped and counted."""

    PERIOD_S = WEEK_S

    def __init__(self, rate_hz: int, baud_rate: int) -> None:
        self.counters: Counter[str] = Counter()
        self.understood = 0
        self.set_up = set_up(rate_hz, baud_rate)
        self._buffer = bytearray()

    def reset(self) -> None:
        """Discard the partial message: the port was opened again."""
        self._buffer.clear()

    def feed(self, data: bytes) -> Iterator[GpsFix]:
        buffer = self._buffer
        buffer += data
        while True:
            at = buffer.find(SYNC)
            if at < 0:
                # The last byte may begin the next message.
                del buffer[: max(0, len(buffer) - 1)]
                return
            del buffer[:at]
            if len(buffer) < HEADER_BYTES:
                return
            size = SIZES.get((buffer[2], buffer[3]))
            if size is None or int.from_bytes(buffer[4:6], "little") != size:
                del buffer[: len(SYNC)]
                continue
            end = HEADER_BYTES + size + CHECK_BYTES
            if len(buffer) < end:
                return
            frame = bytes(buffer[:end])
            if calc_checksum(frame[2:-2]) != frame[-2:]:
                # A message that was cut: the next one begins within it.
                self.counters["checksum"] += 1
                del buffer[: len(SYNC)]
                continue
            del buffer[:end]
            self.understood += 1
            if (frame[2], frame[3]) == NAV_PVT:
                yield self._fix(frame)
            elif (frame[2], frame[3]) == NAK:
                self.counters["set_up_refused"] += 1

    def _fix(self, frame: bytes) -> GpsFix:
        message: Any = UBXReader.parse(frame)
        kind = KINDS.get(message.fixType) if message.gnssFixOk and not message.invalidLlh else None
        if kind == "3d" and message.carrSoln:
            kind = "rtk"
        elif kind == "3d" and message.diffSoln:
            kind = "dgps"
        return GpsFix(
            kind,
            message.iTOW / 1e3,
            message.lat,
            message.lon,
            None if kind == "2d" else message.hMSL / 1e3,
            message.hAcc / 1e3,
            message.gSpeed / 1e3,
            message.headMot,
            -message.velD / 1e3,
            message.numSV,
            message.pDOP,
        )


def set_up(rate_hz: int, baud_rate: int) -> bytes:
    """Return the messages that set a receiver up until it is switched off.

    Receivers from generation 9 on take the first one and refuse some of the others; generation 8
    takes only the others. Set are: the speed, NAV-PVT in place of NMEA, its rate, and the model of
    motion that permits the accelerations of an aircraft.
    """
    period_ms = round(1000 / rate_hz)
    keys = [
        ("CFG_RATE_MEAS", period_ms),
        ("CFG_NAVSPG_DYNMODEL", AIRBORNE_4G),
        ("CFG_MSGOUT_UBX_NAV_PVT_UART1", 1),
        ("CFG_MSGOUT_UBX_NAV_PVT_USB", 1),
        ("CFG_UART1OUTPROT_NMEA", 0),
        ("CFG_USBOUTPROT_NMEA", 0),
        ("CFG_UART1_BAUDRATE", baud_rate),
    ]
    uart = {"inUBX": 1, "inNMEA": 1, "outUBX": 1, "charLen": 3, "parity": 4}
    messages = [
        UBXMessage.config_set(1, 0, keys),
        UBXMessage("CFG", "CFG-RATE", SET, measRate=period_ms, navRate=1, timeRef=1),
        UBXMessage("CFG", "CFG-NAV5", SET, dyn=1, dynModel=AIRBORNE_4G),
        UBXMessage("CFG", "CFG-MSG", SET, msgClass=1, msgID=7, rateUART1=1, rateUSB=1),
        # Last: it changes the speed.
        UBXMessage("CFG", "CFG-PRT", SET, portID=1, baudRate=baud_rate, **uart),
    ]
    return b"".join(each.serialize() for each in messages)
