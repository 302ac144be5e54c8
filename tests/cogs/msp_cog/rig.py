"""The board module at a socket, whose other end answers as a Betaflight board did."""

import socket
from contextlib import suppress
from functools import reduce
from operator import xor
from unittest import mock

from msp_cog import messages
from msp_cog.modules.msp_board import MspBoard
from msp_cog.modules.msp_output import MspOutput
from twisted.internet.defer import Deferred

from tests.cogs.msp_cog.recorded import ANSWERS
from tests.cogs.serial_cog.rig import STEP_S, VirtualReactor, run
from tests.support.system import build_up, started
from up.protocols.serial_line import LAST_FRAME_S
from up.providers.up_location_provider import UpLocationProvider
from up.providers.up_orientation_provider import UpOrientationProvider


def reply(number, payload, direction=b">"):
    body = bytes((len(payload), number)) + payload
    return b"$M" + direction + body + bytes((reduce(xor, body),))


class Rig:
    """``heard`` has the messages to the board that request nothing; ``answers`` may be changed."""

    def __init__(self, folder, modules=(), **files):
        self.answers, self.heard, self.unread = dict(ANSWERS), [], b""
        self.refused, self.lost_every, self.replies = set(), 0, 0
        # A pair of sockets: the other end has immediately what one sends.
        self.end, self.port = socket.socketpair()
        for each in (self.end, self.port):
            each.setblocking(False)
        self.reactor = VirtualReactor()
        config = {f"{name}.yml": text for name, text in files.items()}
        config["config.yml"] = "flight controller: msp\n"
        self._opener = mock.patch("msp_cog.modules.msp_board.open_line", lambda *_: self.end)
        self._opener.start()
        loaded = [MspBoard, MspOutput, *modules]
        self.up = build_up(loaded, self.reactor, folder / "config", config=config)
        self.board = self.up.get_module(MspBoard)
        self.orientation = self.up.get_module(UpOrientationProvider)
        self.location = self.up.get_module(UpLocationProvider)
        self.execute = self.up.command_executor.execute_command
        self.life = run(started(self.up))

    def advance(self, seconds):
        for _ in range(round(seconds / STEP_S)):
            self.reactor.advance(STEP_S)
            self.reactor.turn()
            self._answer()
            self.reactor.turn()

    def take(self, number):
        """Return the payloads of a type that the board was sent, and forget them."""
        taken = [payload for each, payload in self.heard if each == number]
        self.heard = [each for each in self.heard if each[0] != number]
        return taken

    def stop(self):
        stopped = Deferred.fromCoroutine(self.life.stop())
        self.reactor.advance(LAST_FRAME_S)
        assert stopped.called
        self._opener.stop()
        with suppress(BrokenPipeError):
            self._answer()
        self.port.close()

    def _answer(self):
        with suppress(BlockingIOError):
            self.unread += self.port.recv(65536)
        while len(self.unread) >= 6 and len(self.unread) >= 6 + self.unread[3]:
            size, number = self.unread[3:5]
            frame, self.unread = self.unread[: 6 + size], self.unread[6 + size :]
            assert frame[:3] == b"$M<" and reduce(xor, frame[3:]) == 0
            if number in (messages.SET_RAW_RC, messages.SET_ARMING_DISABLED):
                self.heard.append((number, frame[5:-1]))
            if number in self.refused:
                self.port.send(reply(number, b"", b"!"))
                continue
            self.replies += 1
            if self.answers and not (self.lost_every and self.replies % self.lost_every == 0):
                self.port.send(reply(number, self.answers.get(number, b"")))
