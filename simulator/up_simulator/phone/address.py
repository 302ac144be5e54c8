"""How the phone finds the Raspberry Pi: by configuration, Discovery, or through a runner."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.error import ConnectError
from twisted.internet.protocol import DatagramProtocol, Factory
from twisted.protocols.basic import LineOnlyReceiver
from twisted.python.failure import Failure

from up.protocols.envelope import EnvelopeError
from up.protocols.pairing import Pairing
from up.protocols.runner_session import RunnerSession
from up.system.addresses import is_private
from up.system.clock import cancel

ANSWER_S = 1.5
SPAWN_S = 20.0
MAX_ANSWER = 65536
QUESTION = b"Where is Raspilot?"


class NotFoundError(Exception):
    """The Raspberry Pi cannot be found now: one sentence, and the runner's code if it has one."""

    def __init__(self, text: str, code: str = "not_found") -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True)
class RaspberryPi:
    """Where the phone's two links go."""

    host: str
    general_port: int
    orientation_port: int


@dataclass(frozen=True, slots=True)
class Runner:
    """A runner that is asked for an instance first, the aircraft's name, and the key to sign by."""

    host: str
    port: int
    aircraft: str
    pairing: Pairing | None = None


async def discover(reactor: Any, host: str, port: int) -> str:
    """Query Discovery (protocols 7) once and return the Raspberry Pi's address.

    ``host`` may be a broadcast address. Raises ``NotFoundError`` without an answer.
    """
    question = _Question(host, port)
    listening = reactor.listenUDP(0, question)
    limit = reactor.callLater(ANSWER_S, question.give_up)
    try:
        return await question.answer
    finally:
        cancel(limit)
        await listening.stopListening()


async def spawn(reactor: Any, runner: Runner) -> RaspberryPi:
    """Request an instance from a runner (protocols 8) and return its address.

    Raises ``NotFoundError`` with the runner's own sentence when nothing runs.
    """
    request = json.dumps({"aircraft": runner.aircraft}).encode("ascii")
    return read_spawn_answer(await ask_runner(reactor, runner, request), runner.host)


async def ask_runner(reactor: Any, runner: Runner, request: bytes) -> bytes:
    """Return a runner's answer to a request, both a line without its LF.

    With a key both are protected: a plain answer is then refused. Raises ``NotFoundError`` without
    an answer.
    """
    endpoint = TCP4ClientEndpoint(reactor, runner.host, runner.port, timeout=ANSWER_S)
    try:
        factory: Any = Factory.forProtocol(_Request)
        factory.noisy = False
        protocol: Any = await endpoint.connect(factory)
    except ConnectError as error:
        raise NotFoundError(f"no runner at {runner.host}:{runner.port}: {error}") from error
    limit = reactor.callLater(SPAWN_S, protocol.transport.abortConnection)
    try:
        if runner.pairing is None:
            answer: bytes = await protocol.ask(request + b"\n")
            return answer
        session = RunnerSession(runner.pairing)
        said = await protocol.ask(session.hello())
        return session.result(await protocol.ask(session.request(said, request)))
    except EnvelopeError as refusal:
        text = f"no protected answer of the runner for {runner.aircraft}: {refusal.code}"
        raise NotFoundError(text, refusal.code) from None
    finally:
        cancel(limit)
        protocol.transport.loseConnection()


def read_spawn_answer(line: bytes, host: str) -> RaspberryPi:
    """Return the place that a runner's answer names, at ``host`` unless it names another one.

    Raises ``NotFoundError``.
    """
    try:
        answer = json.loads(line)
        if answer["running"] is not True:
            text = f"refused by the runner: {answer.get('error') or answer.get('message')}"
            raise NotFoundError(text, answer.get("code") or "refused")
        ports = answer["ports"]
        general, orientation = ports["general"], ports["orientation"]
        host = str(answer.get("host") or host)
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError) as error:
        raise NotFoundError(f"the runner's answer is invalid: {line[:80]!r}") from error
    if not all(type(each) is int and 1 <= each <= 65535 for each in (general, orientation)):
        raise NotFoundError(f"the runner's ports are invalid: {ports}")
    return RaspberryPi(host, general, orientation)


def read_discovery_answer(answer: bytes, source: str) -> str | None:
    """Return the sender's address; None: the answer names another, or it is public."""
    is_own = answer.strip() in (b"", source.encode("ascii"))
    return source if is_own and is_private(source) else None


class _Question(DatagramProtocol):
    """One question to Discovery and its first answer."""

    def __init__(self, host: str, port: int) -> None:
        self._place = (host, port)
        self._refused = ""
        self.answer: Deferred[str] = Deferred()

    def startProtocol(self) -> None:  # noqa: N802 - Twisted's name
        transport: Any = self.transport
        transport.setBroadcastAllowed(True)
        transport.write(QUESTION, self._place)

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802
        host = read_discovery_answer(datagram, addr[0])
        if host is None:
            self._refused = f"; refused {datagram[:40]!r} from {addr[0]}"
        elif not self.answer.called:
            self.answer.callback(host)

    def give_up(self) -> None:
        host, port = self._place
        if not self.answer.called:
            self.answer.errback(
                Failure(NotFoundError(f"no answer from Discovery at {host}:{port}{self._refused}"))
            )


class _Request(LineOnlyReceiver):
    """Requests to a runner, one after the other, and an answer of one line to each."""

    delimiter = b"\n"
    MAX_LENGTH = MAX_ANSWER

    def __init__(self) -> None:
        self.answer: Deferred[bytes] = Deferred()

    def ask(self, line: bytes) -> Deferred[bytes]:
        transport: Any = self.transport
        self.answer = Deferred()
        transport.write(line)
        return self.answer

    def lineReceived(self, line: bytes) -> None:  # noqa: N802 - Twisted's name
        if not self.answer.called:
            self.answer.callback(line)

    def connectionLost(self, reason: Any = None) -> None:  # noqa: N802 - Twisted's name
        if not self.answer.called:
            self.answer.errback(Failure(NotFoundError("the runner closed the connection")))
