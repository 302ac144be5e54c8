"""The NATS client's bounded buffer and its view of a silent server, on a virtual clock."""

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.error import ConnectionDone
from twisted.internet.task import Clock
from twisted.logger import capturedLogs
from twisted.python.failure import Failure

from tests.support.transport import Transport
from up_cluster import nats_client, nats_protocol
from up_cluster.config import Server

INFO = b'INFO {"server_name":"s0"}\r\n'


def linked():
    clock = Clock()
    seen = []
    client = nats_client.NatsClient(
        clock, [Server("127.0.0.1", 4222)], name="test", on_connected=seen.append
    )
    link = client._build()
    transport = Transport("127.0.0.1")
    link.makeConnection(transport)
    link.dataReceived(INFO + nats_protocol.PONG)
    assert seen == [True]
    transport.clear()
    return clock, client, link, transport


def publish(client, subject, body):
    client.publish(subject, body)


def publish_by_publisher(client, subject, body):
    client.publisher(subject)(body)


ways_to_publish = pytest.mark.parametrize("send", [publish, publish_by_publisher])


@ways_to_publish
def test_the_oldest_data_behind_a_slow_server_are_dropped(send):
    _, client, link, transport = linked()
    link.pauseProducing()
    body = b"x" * 1000
    count = nats_client.MAX_WAITING_BYTES // 1000 + 10
    for number in range(count):
        send(client, f"data.{number}", body)
    client.subscribe("control", print)
    assert transport.value() == b"SUB control 1\r\n"
    assert 10 < client.dropped < 100
    link.resumeProducing()
    subjects = [line.split()[1] for line in transport.value().split(b"\r\n") if line[:3] == b"PUB"]
    assert subjects == [b"data.%d" % n for n in range(client.dropped, count)]
    transport.clear()
    send(client, "data", b"new")
    assert transport.value() == b"PUB data 3\r\nnew\r\n"
    with pytest.raises(ValueError, match="not a subject"):
        send(client, "da ta", b"")


def test_a_silent_server_is_left():
    clock, _, link, transport = linked()
    for _ in range(4):
        clock.advance(nats_client.PING_S)
        link.dataReceived(nats_protocol.PONG)
    assert transport.value().count(nats_protocol.PING) == 4
    assert not transport.disconnecting
    clock.pump([nats_client.PING_S] * 5)
    assert transport.disconnected or transport.disconnecting
    assert link._failed[0] == "silent"


def test_no_password_goes_to_a_server_that_requires_tls():
    login = {"user": "club", "pass": "secret"}
    client = nats_client.NatsClient(Clock(), [Server("127.0.0.1", 1)], name="test", login=login)
    link = client._build()
    transport = Transport("127.0.0.1")
    link.makeConnection(transport)
    link.dataReceived(b'INFO {"tls_required":true}\r\n')
    assert transport.value() == b"" and transport.disconnected
    link.connectionLost(Failure(ConnectionDone()))
    assert [code for code, _ in client.failures] == ["nats_refused"]


def test_subscriptions_that_change_during_the_handshake():
    client = nats_client.NatsClient(Clock(), [Server("127.0.0.1", 4222)], name="test")
    ended = client.subscribe("ended", print)
    link = client._build()
    transport = Transport("127.0.0.1")
    link.makeConnection(transport)
    link.dataReceived(INFO)
    client.unsubscribe(ended)
    client.subscribe("begun", print)
    link.dataReceived(nats_protocol.PONG)
    made = [line for line in transport.value().split(b"\r\n") if line.startswith(b"SUB")]
    assert made == [b"SUB begun 2"]


@ways_to_publish
def test_nothing_waits_for_a_connection(send):
    client = nats_client.NatsClient(Clock(), [Server("127.0.0.1", 4222)], name="test")
    send(client, "data", b"old")
    assert client.dropped == 1


def test_payloads_of_a_subscription_until_its_end_and_from_the_next_server():
    _, client, link, _ = linked()
    heard = []
    sid = client.subscribe_payloads("data", heard.append)
    message = b"MSG data %d 2\r\nab\r\n" % sid
    link.dataReceived(message + b"MSG data %d _INBOX.1 3\r\nask\r\n" % sid)
    assert heard == [b"ab", b"ask"]
    following = client._build()
    following.makeConnection(Transport("127.0.0.1"))
    following.dataReceived(INFO + nats_protocol.PONG + message)
    assert heard == [b"ab", b"ask", b"ab"]
    client.unsubscribe(sid)
    following.dataReceived(message)
    assert heard == [b"ab", b"ask", b"ab"]


def test_its_end_is_not_reported_as_a_loss():
    _, client, link, _ = linked()
    with capturedLogs() as logs:
        Deferred.fromCoroutine(client.stop())
        link.connectionLost(Failure(ConnectionDone()))
    assert logs == []
