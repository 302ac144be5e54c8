"""Echoes a serial port through the reactor and ``SerialLine``, and does nothing else.

usage: python -m bench.serial_echo PORT REALTIME_PRIORITY. The cost of the daemon's transport alone.
"""

import gc
import sys
from typing import Any

from twisted.internet import reactor

from up.protocols.serial_line import SerialLine
from up.protocols.serial_port import open_serial
from up.system.scheduling import use_realtime_priority


def main(port: str, priority: int) -> None:
    loop: Any = reactor
    line = SerialLine(
        loop,
        lambda: open_serial(port, 115200),
        on_bytes=lambda data: line.write(data),
        on_opened=lambda: line.write(b"\0"),
        on_lost=lambda why: loop.stop(),
    )
    use_realtime_priority(priority)
    line.start()
    gc.freeze()
    gc.disable()
    loop.run()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
