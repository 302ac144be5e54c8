import pytest

from up.system.peer_filter import PeerFilter

KEY = "x.yml: i_accept_plain"


@pytest.mark.parametrize("address", ["", "0.0.0.0", "::", "127.0.0.1", "192.168.1.4", "fe80::1"])
def test_private_and_wildcard_addresses_may_listen(address):
    assert PeerFilter(False, KEY).refusal_of(address) == ""


def test_a_public_address_may_not_listen_unless_accepted():
    refusal = PeerFilter(False, KEY).refusal_of("203.0.113.9")
    assert "203.0.113.9" in refusal and KEY in refusal
    assert PeerFilter(True, KEY).refusal_of("203.0.113.9") == ""


def test_a_name_is_no_address_to_listen_on():
    assert PeerFilter(False, KEY).refusal_of("localhost")


@pytest.mark.parametrize(
    ("host", "permitted"),
    [
        ("127.0.0.1", True),
        ("100.64.0.9", True),
        ("::ffff:192.168.0.7", True),
        ("fe80::1%eth0", True),
        ("8.8.8.8", False),
        ("::ffff:8.8.8.8", False),
        ("2001:db8::1", False),
        ("0.0.0.0", False),
        ("", False),
        ("somebody", False),
    ],
)
def test_each_peer_is_judged(host, permitted):
    peers = PeerFilter(False, KEY)
    assert peers.permits(host) is permitted
    assert peers.refused == (not permitted)


def test_accepted_means_everybody():
    assert PeerFilter(True, KEY).permits("8.8.8.8")
