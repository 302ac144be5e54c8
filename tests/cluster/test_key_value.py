"""A watch whose consumer is not made, on a virtual clock."""

import json

import pytest

from tests.cluster.test_nats_client import linked
from up_cluster.key_value import CONSUMER_LIMIT_S, WATCH_RETRY_S, KeyValueBucket


def requests(transport):
    """Return where the answers to the requests for a consumer go."""
    lines = transport.value().split(b"\r\n")
    return [each.split()[2] for each in lines if b"CONSUMER.CREATE" in each]


@pytest.mark.parametrize(
    ("is_refused", "pause_s"), [(False, CONSUMER_LIMIT_S), (True, WATCH_RETRY_S)]
)
def test_it_asks_again_at_once_without_an_answer_and_later_after_a_refusal(is_refused, pause_s):
    clock, client, link, transport = linked()
    client.subscribe(f"{client._inbox}.*", client._on_answer)
    found, current = [], []
    watch = KeyValueBucket(client, "b").watch("a.*", found.append, current.append, clock)
    (reply,) = requests(transport)
    if is_refused:
        answer = json.dumps({"error": {"err_code": 10059, "description": "none"}}).encode()
        link.dataReceived(b"MSG %b 1 %d\r\n%b\r\n" % (reply, len(answer), answer))
    clock.advance(pause_s - 0.1)
    assert len(requests(transport)) == 1
    clock.pump([0.1, 0.0])
    assert len(requests(transport)) == 2
    assert current == []
    watch.stop()
