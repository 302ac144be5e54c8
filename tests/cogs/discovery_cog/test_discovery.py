import socket

import pytest
from discovery_cog.answerer import Answerer, RateLimit, own_address_towards
from discovery_cog.modules.discovery_service import DiscoveryService
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet.task import Clock

from tests.cogs.peers import UdpPeer
from tests.support.reactor import reactor, until
from tests.support.system import build_up
from up.life_cycle import LifeCycle
from up.mode import Mode


class Network:
    """A transport that keeps written data."""

    def __init__(self, fault=None):
        self.written = []
        self.fault = fault

    def write(self, data, address):
        if self.fault:
            raise self.fault
        self.written.append((data, address))


def answerer(clock=None, own="192.168.1.5", fault=None):
    made = Answerer(RateLimit(clock or Clock()), lambda host, port: own)
    made.transport = Network(fault)
    return made


def system(tmp_path, port=0, mode=Mode.AUTO):
    return build_up([DiscoveryService], reactor, tmp_path, mode=mode,
                    config={"discovery.yml": f"port: {port}\n"})  # fmt: skip


@pytest.mark.parametrize(
    ("content", "to"),
    [
        *((content, "127.0.0.1") for content in (b"", b"hello", b"\x00\xff", b"x" * 512)),
        (b"a broadcast", "127.255.255.255"),
    ],
)
async def test_any_datagram_is_answered_with_our_address_as_text(tmp_path, content, to):
    up = system(tmp_path)
    life = LifeCycle(up)
    await life.start()
    phone = UdpPeer(reactor, "127.0.0.1")
    phone.transport.setBroadcastAllowed(True)
    phone.say(content, up.ports["discovery"], to)
    await until(lambda: phone.datagrams)
    assert phone.datagrams == [b"127.0.0.1"]
    await phone.close()
    await life.stop()


async def test_a_port_in_use_is_a_veto_and_the_system_runs(tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("", 0))
        number = taken.getsockname()[1]
        up = system(tmp_path, number)
        life = LifeCycle(up)
        await life.start()
        (reason,) = up.vetoes.own.values()
        assert f"{number}" in reason
        assert "(discovery.yml: port)" in reason
        assert life.started
        await life.stop()


def test_black_box_mode_has_no_discovery(tmp_path):
    up = system(tmp_path, mode=Mode.BLACK_BOX)
    assert up.get_module(DiscoveryService) is None


def test_ten_answers_a_second_for_each_sender():
    clock = Clock()
    made = answerer(clock)
    for _ in range(25):
        made.datagramReceived(b"?", ("192.168.1.7", 5))
        made.datagramReceived(b"?", ("192.168.1.8", 6))
    assert made.counters == {"answered": 20, "too_often": 30}
    clock.advance(1.01)
    made.datagramReceived(b"?", ("192.168.1.7", 5))
    assert made.counters["answered"] == 21


def test_another_port_is_the_same_sender():
    made = answerer()
    for port in range(1, 30):
        made.datagramReceived(b"?", ("192.168.1.7", port))
    assert made.counters["answered"] == 10


def test_a_flood_of_senders_costs_bounded_memory():
    clock = Clock()
    limit = RateLimit(clock)
    permitted = sum(limit.permits(f"10.0.{n // 250}.{n % 250}") for n in range(5000))
    assert (permitted, len(limit)) == (256, 256)
    clock.advance(1)
    assert limit.permits("10.9.9.9")
    assert len(limit) == 256


@pytest.mark.parametrize("sender", ["8.8.8.8", "203.0.113.7"])
def test_a_public_sender_gets_no_answer(sender):
    made = answerer()
    made.datagramReceived(b"?", (sender, 5))
    assert made.transport.written == []
    assert made.counters["foreign"] == 1


def test_a_long_request_is_ignored():
    made = answerer()
    made.datagramReceived(b"x" * 513, ("192.168.1.7", 5))
    assert made.transport.written == []


def test_no_route_to_the_sender_is_counted():
    for made in (answerer(own=None), answerer(fault=OSError(101, "Network is unreachable"))):
        made.datagramReceived(b"?", ("192.168.1.7", 5))
        assert made.counters == {"unreachable": 1}


@given(st.binary(max_size=600), st.integers(0, 65535))
def test_any_datagram_is_answered_or_counted(request, port):
    made = answerer()
    made.datagramReceived(request, ("192.168.1.7", port))
    assert sum(made.counters.values()) == 1
    assert all(written == (b"192.168.1.5", ("192.168.1.7", port))
               for written in made.transport.written)  # fmt: skip


def test_our_address_is_that_of_the_senders_subnet():
    assert own_address_towards("127.0.0.9", 9) == "127.0.0.1"
    assert own_address_towards("255.255.255.255", 9) is None
