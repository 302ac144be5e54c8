import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.system.addresses import is_private, is_wildcard, neighbourhood, plain

PRIVATE = [
    "127.0.0.1", "127.255.255.254", "10.0.0.1", "172.16.0.1", "172.31.255.254", "192.168.1.1",
    "169.254.7.7", "100.64.0.1", "100.127.255.254", "::1", "fe80::1", "fe80::1%eth0", "fd00::1",
    "::ffff:10.0.0.1",
]  # fmt: skip
PUBLIC = [
    "0.0.0.0", "::", "8.8.8.8", "172.15.255.255", "172.32.0.1", "192.169.0.1", "100.63.255.255",
    "100.128.0.1", "203.0.113.9", "198.51.100.1", "2001:db8::1", "2a00::1", "64:ff9b::a00:1",
    "::ffff:8.8.8.8", "255.255.255.255", "224.0.0.1",
]  # fmt: skip


@pytest.mark.parametrize("host", PRIVATE)
def test_private(host):
    assert is_private(host)


@pytest.mark.parametrize("host", PUBLIC)
def test_public(host):
    assert not is_private(host)


@pytest.mark.parametrize(
    ("host", "answer"),
    [("", True), ("0.0.0.0", True), ("::", True), ("127.0.0.1", False), ("::1", False)],
)
def test_wildcards(host, answer):
    assert is_wildcard(host) is answer


@pytest.mark.parametrize("host", ["localhost", "1.2.3", "1.2.3.4.5", "::g", "010.0.0.1"])
def test_what_is_no_address_is_refused(host):
    for judge in (is_private, is_wildcard, plain, neighbourhood):
        with pytest.raises(ValueError, match=host):
            judge(host)


def test_how_people_write_it():
    assert plain("::ffff:1.2.3.4") == "1.2.3.4"
    assert plain("fe80::1%eth0") == "fe80::1"


def test_neighbours():
    assert neighbourhood("1.2.3.4") == neighbourhood("::ffff:1.2.3.4") == "1.2.3.4"
    assert neighbourhood("2001:db8::1") == neighbourhood("2001:db8::ffff:2") == "2001:db8::/64"
    assert neighbourhood("2001:db8:0:1::1") == "2001:db8:0:1::/64"


@given(st.ip_addresses())
def test_every_address_is_judged(address):
    host = str(address)
    assert is_private(host) in (True, False)
    assert neighbourhood(host)
    assert not (is_wildcard(host) and is_private(host))
