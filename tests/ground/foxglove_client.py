"""A client of `up-ground foxglove` that speaks the protocol."""

import json
import struct

from autobahn.twisted.websocket import WebSocketClientFactory, WebSocketClientProtocol
from twisted.internet.endpoints import TCP4ClientEndpoint

from tests.support.reactor import reactor, until

SUBPROTOCOL = "foxglove.sdk.v1"
MESSAGE = struct.Struct("<BIQ")
"""Opcode 1, number of the subscription, time in ns."""


class Client(WebSocketClientProtocol):
    """`told` has the texts, `taken` the decoded messages and times by their subscription."""

    def __init__(self):
        super().__init__()
        self.told, self.taken, self.is_over = [], {}, False

    def onMessage(self, payload, isBinary):  # noqa: N802, N803
        if not isBinary:
            self.told.append(json.loads(payload))
            return
        opcode, subscription, time_ns = MESSAGE.unpack_from(payload)
        assert opcode == 1
        message = json.loads(payload[MESSAGE.size :])
        self.taken.setdefault(subscription, []).append((time_ns, message))

    def onClose(self, *_):  # noqa: N802
        self.is_over = True

    def say(self, op, **fields):
        self.sendMessage(json.dumps({"op": op, **fields}).encode())

    def of(self, op):
        return [each for each in self.told if each["op"] == op]

    async def channels(self):
        """Return the advertised channels by their topics."""
        await until(lambda: len(self._channels()) == 2, what="two channels")
        return self._channels()

    async def subscribe(self):
        """Subscribe to the frames as 1, and to the places as 2."""
        channels = await self.channels()
        topics = (channels["up.telemetry.update"], channels["/location"])
        wanted = [{"id": at, "channelId": each["id"]} for at, each in enumerate(topics, 1)]
        self.say("subscribe", subscriptions=wanted)

    def _channels(self):
        return {each["topic"]: each for told in self.of("advertise") for each in told["channels"]}


async def connected(address):
    """Return a client of the server at HOST:PORT."""
    factory = WebSocketClientFactory(f"ws://{address}", protocols=[SUBPROTOCOL], reactor=reactor)
    factory.noisy, factory.protocol = False, Client
    host, _, number = address.rpartition(":")
    client = await TCP4ClientEndpoint(reactor, host, int(number)).connect(factory)
    await until(lambda: client.state == Client.STATE_OPEN, what="the handshake")
    return client


async def ended(client):
    client.transport.abortConnection()
    await until(lambda: client.is_over)
