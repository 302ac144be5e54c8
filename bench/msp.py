"""A Betaflight board (SITL) by MSP: answers a second, set-points and the switch to its output."""

import shutil
import socket
import time
from collections.abc import Callable, Iterable
from contextlib import closing, suppress

from msp_cog.codec import MspDecoder, encode
from msp_cog.messages import ATTITUDE, SET_RAW_RC, pack_sticks
from msp_cog.poller import EVERY_TICK, SELDOM

from bench.table import LeftOutError, Row, compared
from bench.timing import Limit
from up_simulator.aircraft import FlightDynamics, load_airframe
from up_simulator.betaflight.board import PROGRAM, BetaflightBoard
from up_simulator.betaflight.packets import MSP_PORT
from up_simulator.betaflight.world import BetaflightWorld
from up_simulator.harness.world import STEP_S, THROTTLE

TICK_S = 0.02
LIMIT_S = 10.0
MAX_ANSWER_MS, MAX_SWITCH_MS = 20.0, 300.0
PILOT_US, OTHER_US, BETWEEN_US = 1200, 1700, 1450


def rows(quick: bool) -> Iterable[Row]:
    """Yield the figures of one flight in real time."""
    if shutil.which(PROGRAM) is None:
        raise LeftOutError(f"{PROGRAM} is not installed")
    dynamics = FlightDynamics(load_airframe("glider"))
    with closing(BetaflightBoard(dynamics)) as board:
        world = BetaflightWorld(dynamics, board)
        world.boot(arms=True)
        line = socket.create_connection(("127.0.0.1", MSP_PORT))
        line.setblocking(False)
        decoder, answers_ms, asked_s = MspDecoder(), list[float](), [0.0]
        sticks = encode(SET_RAW_RC, pack_sticks((1500, 1500, OTHER_US, 1500)))
        requests = b"".join(map(encode, (SELDOM[0], *EVERY_TICK)))

        def fly(is_over: Callable[[], bool]) -> float:
            """Fly until a condition holds, and return the seconds."""
            begin_s = next_s = time.perf_counter()
            while not is_over():
                world.step()
                now_s = time.perf_counter()
                if now_s - begin_s > LIMIT_S:
                    raise RuntimeError("the board does not follow")
                if now_s - asked_s[0] >= TICK_S:
                    asked_s[0] = now_s
                    line.send(sticks + requests)
                with suppress(BlockingIOError):
                    if any(number == ATTITUDE for number, _ in decoder.feed(line.recv(4096))):
                        answers_ms.append((now_s - asked_s[0]) * 1000)
                next_s += STEP_S
                time.sleep(max(0.0, next_s - time.perf_counter()))
            return time.perf_counter() - begin_s

        fly(lambda: board.on_ground is None)
        board.set_stick("throttle", PILOT_US)
        board.set_stick("aux2", 2000)
        on_ms, off_ms = list[float](), list[float]()
        for _ in range(2 if quick else 20):
            board.set_stick("aux1", 2000)
            on_ms.append(1000 * fly(lambda: board.pulses_us()[THROTTLE] > BETWEEN_US))
            board.set_stick("aux1", 1500)
            off_ms.append(1000 * fly(lambda: board.pulses_us()[THROTTLE] < BETWEEN_US))
        line.close()
    yield compared("Betaflight by MSP: answer to 4 requests", "ms", answers_ms,
                   limit=Limit(MAX_ANSWER_MS))  # fmt: skip
    yield compared("switch to AUTO until set-points move the output", "ms", on_ms)
    yield compared("switch from AUTO until the sticks move it", "ms", off_ms,
                   limit=Limit(MAX_SWITCH_MS))  # fmt: skip
