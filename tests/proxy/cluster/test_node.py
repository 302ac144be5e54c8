"""A node of a cluster, without NATS."""

from pathlib import Path

from twisted.internet.testing import MemoryReactorClock
from twisted.logger import capturedLogs

from up_cluster.config import ClusterConfig
from up_proxy.cluster.node import ClusterNode
from up_proxy.cluster.node_messages import ENVELOPE
from up_proxy.cluster.sender_ages import SETTLE_S
from up_proxy.config import QuotaConfig
from up_proxy.poller import Poller
from up_proxy.tenant_quota import TenantQuota


def test_a_bug_costs_one_message_of_another_node():
    clock = MemoryReactorClock()
    quota = TenantQuota(clock, QuotaConfig())
    config = ClusterConfig(servers="nats://127.0.0.1")
    node = ClusterNode(clock, Poller(clock, clock.seconds), config, Path(), quota)
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
