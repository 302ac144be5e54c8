"""Flies for some seconds and prints one digest of everything that passed and of where it ended.

python -m tests.simulator.in_process.determinism SEED
"""

import hashlib
import sys
import tempfile
from pathlib import Path

from tests.simulator.in_process.flying import CELLULAR, Flying
from up_simulator.in_process.tcp_connection import TcpConnection
from up_simulator.link.model import LinkSettings
from up_simulator.scenario.event import SerialNoise

LOSSY = LinkSettings(CELLULAR.delay_ms, CELLULAR.jitter_ms, loss_percent=5, rate_bytes_s=60_000)
NOISE = SerialNoise(3600, flipped_percent=0.2, inserted_percent=0.1, lost_percent=0.1)


def digests(folder, seed, duration_s=3.0):
    """Return the digests of the serial line, of all connections, and of the flight."""
    passed = hashlib.sha256()
    transmit = TcpConnection.transmit

    def transmit_and_note(end, data):
        passed.update(b"%r %r\n" % (end._clock.seconds(), data))
        transmit(end, data)

    TcpConnection.transmit = transmit_and_note
    try:
        flying = Flying(folder, seed=seed, link=LOSSY, orientation="udp")
        flying.board.wires.set_noise(NOISE, 0.0)
        flying.start()
        flying.fly(duration_s / 3)
        flying.ask("up.telemetry.frequency", limit_s=5.0, frequency=50)
        flying.raspilot.kill()
        flying.raspilot.start()
        flying.fly(duration_s / 3)
        flying.phone.unplug()
        flying.fly(duration_s / 3)
        assert flying.ground.frames > 5
        log = "\n".join([*flying.raspilot.log, *flying.phone.messages])
        ended = repr((flying.state, flying.ground.telemetry, log))
        flying.raspilot.kill()
    finally:
        TcpConnection.transmit = transmit
    return (
        flying.board.digest.hexdigest(),
        passed.hexdigest(),
        hashlib.sha256(ended.encode()).hexdigest(),
    )


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        print(*digests(Path(name), int(sys.argv[1])))
