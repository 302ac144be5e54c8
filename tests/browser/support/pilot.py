"""The radio of a test: takes over the sticks of a showcase and reports the aircraft's motion.

Reads JSON lines: ``{"ailerons": 1700, "aux1": 2000}`` moves sticks from then on, ``null`` gives
them back. Writes a JSON line for every answer of the aircraft: ``unix_s``, ``roll_deg``,
``pitch_deg``, ``height_m``, ``airspeed_m_s``, ``mode``. Ends with its standard input.
"""

import json
import selectors
import sys
import time
from dataclasses import replace
from pathlib import Path

from up_simulator.radio.rc_override import PERIOD_S, RadioLink
from up_simulator.radio.remote_messages import write_sticks

STATE = ("roll_deg", "pitch_deg", "height_m", "airspeed_m_s")


def main(path):
    link = RadioLink(Path(path))
    sticks = None
    base = link.snapshot.sticks
    told = None
    watched = selectors.DefaultSelector()
    watched.register(sys.stdin, selectors.EVENT_READ)
    try:
        while True:
            if watched.select(PERIOD_S):
                line = sys.stdin.readline()
                if not line:
                    return
                moved = json.loads(line)
                sticks = None if moved is None else replace(sticks or base, **moved)
            snapshot = link.exchange(write_sticks(sticks))
            if snapshot is not told:
                told = snapshot
                values = {name: getattr(snapshot.state, name) for name in STATE}
                print(
                    json.dumps({"unix_s": time.time(), "mode": snapshot.mode, **values}), flush=True
                )
    finally:
        link.close()


main(sys.argv[1])
