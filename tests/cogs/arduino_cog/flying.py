"""A board that flies the compiled firmware, and `python main.py`, on a real pty."""

import os
from contextlib import contextmanager

from tests.cogs.arduino_cog.bench_board import BenchBoard
from tests.cogs.arduino_cog.daemon import Daemon
from tests.support.firmware import build_firmware

CALM = "panic threshold: 100\n"


def firmware():
    """Return the ELF file; RASPILOT_ELF names another one, such as one with a rule removed."""
    return os.environ.get("RASPILOT_ELF") or build_firmware()


def await_profile(board, ground):
    """Wait until the board has the values of airframe.yml."""
    board.wait(lambda: not any("airframe.yml" in veto for veto in ground.at("vetoes")), "profile")


@contextmanager
def flying(elf, folder, sticks=None, motion=None, **files):
    """A board that flies and a daemon that speaks to it; the ground sees 20 frames a second."""
    board = BenchBoard(elf, folder / "board", sticks)
    board.motion = motion
    daemon = Daemon(folder, board.link, **{"load_guard": CALM, **files})
    try:
        board.fly()
        ground = daemon.start()
        ground.ask("up.telemetry.frequency", frequency=50)
        ground.sees("the link", arduino__connected=True, armed=False)
        await_profile(board, ground)
        yield board, daemon
    finally:
        daemon.end()
        board.end()
