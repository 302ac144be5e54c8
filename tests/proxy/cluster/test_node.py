"""A node of a cluster, without NATS."""

import gc
import weakref
from pathlib import Path

import pytest
from twisted.internet.testing import MemoryReactorClock
from twisted.logger import capturedLogs

from up.log import Limited
from up_cluster.config import ClusterConfig
from up_proxy.cluster.node import ClusterNode
from up_proxy.cluster.node_messages import ENVELOPE
from up_proxy.cluster.sender_ages import SETTLE_S
from up_proxy.config import QuotaConfig
from up_proxy.poller import Poller
from up_proxy.tenant_quota import TenantQuota


@pytest.fixture
def clock():
    return MemoryReactorClock()


@pytest.fixture
def poller(clock):
    found = Poller(clock, clock.seconds)
    found.busy_poll_s = 0.0
    return found


@pytest.fixture
def node(clock, poller):
    config = ClusterConfig(servers="nats://127.0.0.1")
    return ClusterNode(clock, poller, config, Path(), TenantQuota(clock, QuotaConfig()))


def test_a_bug_costs_one_message_of_another_node(clock, node):
    taken = []

    def take(message):
        if message.body == b"bug":
            raise ZeroDivisionError
        taken.append(message.body)

    receive = node._client.payloads[b"%d" % node.subscribe("up.default.a.down", take)]
    with capturedLogs() as logs:
        for body in (b"new", b"bug", b"next"):
            receive(ENVELOPE % (b"other", 1, int(clock.seconds() * 1000), 0, body))
            clock.advance(2 * SETTLE_S)
    assert taken == [b"next"]
    assert [each["code"] for each in logs if "log_failure" in each] == ["cluster_bug"]


def test_an_aircraft_that_left_is_freed_without_the_collector(clock, poller, node):
    gc.disable()
    try:
        session = node.new_session("a", poller, Limited(clock, 1.0))
        left = weakref.ref(session)
        session.close()
        node.batches.add("other", session)
        del session
        clock.advance(0)
        clock.advance(0)
        assert left() is None
        assert node._report({})["aircraft"] == []
    finally:
        gc.enable()
