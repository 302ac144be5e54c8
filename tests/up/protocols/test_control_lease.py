import itertools
from dataclasses import dataclass

import pytest

from up.protocols.control_lease import ALIVE_S, TRANSITIONS, ControlLease, Input, State


@dataclass
class Peer:
    last_rx_s: float = 0.0


def owned(token="secret", last_rx_s=10.0):
    lease, owner = ControlLease(), Peer(last_rx_s)
    assert lease.acquire(owner, token) is None
    return lease, owner


def test_a_new_lease_is_free():
    lease = ControlLease()
    assert lease.is_free(0.0)
    assert lease.live_owner(0.0) is None
    assert not lease.is_resumed_by("x")


def test_a_silent_owner_keeps_its_lease_for_three_seconds_and_until_another_acquires_it():
    lease, owner = owned()
    assert not lease.is_free(10.0 + ALIVE_S)
    assert lease.is_free(10.01 + ALIVE_S)
    owner.last_rx_s = 20.0
    assert not lease.is_free(20.0)
    assert lease.live_owner(20.0) is owner
    assert lease.acquire(Peer(), "new") is owner
    assert not lease.is_resumed_by("secret")


@pytest.mark.parametrize("token", ["secreT", "", None])
def test_only_its_token_resumes_a_lease(token):
    lease, _ = owned()
    assert lease.is_resumed_by("secret")
    assert not lease.is_resumed_by(token)


def test_a_lease_is_reserved_for_the_token_of_an_owner_that_disconnects():
    lease, _ = owned()
    lease.disconnect()
    assert lease.live_owner(10.0) is None
    assert not lease.is_free(10.0 + ALIVE_S)
    assert lease.is_free(10.01 + ALIVE_S)
    assert lease.is_resumed_by("secret")


def test_a_released_lease_is_free_immediately_and_its_token_is_invalid():
    lease, _ = owned()
    lease.release()
    assert lease.is_free(10.0)
    assert not lease.is_resumed_by("secret")


def test_an_owner_without_a_token_reserves_nothing():
    lease, _ = owned(token=None)
    assert not lease.is_resumed_by(None)
    lease.disconnect()
    assert lease.is_free(10.0)


def test_every_sequence_of_inputs_follows_the_table():
    """All sequences of four calls, each at a time when the previous owner is alive or silent."""
    calls = [Input.ACQUIRE, Input.DISCONNECT, Input.RELEASE, Input.TIMEOUT, Input.RECEIVE]
    for sequence in itertools.product(calls, repeat=4):
        lease, owner, now_s, expected = ControlLease(), None, 0.0, State.FREE
        last_rx_s = 0.0
        for input_ in sequence:
            if input_ is Input.ACQUIRE:
                owner, last_rx_s = Peer(now_s), now_s
                lease.acquire(owner, "token")
            elif input_ is Input.TIMEOUT:
                now_s += ALIVE_S + 1
            elif input_ is Input.RECEIVE:
                if owner is None:
                    continue
                owner.last_rx_s = last_rx_s = now_s
            else:
                if input_ is Input.DISCONNECT and owner is None:
                    continue
                owner = None
                lease.disconnect() if input_ is Input.DISCONNECT else lease.release()
            expected = TRANSITIONS.get((expected, input_), expected)
            if expected is State.RESERVED and now_s > last_rx_s + ALIVE_S:
                expected = State.FREE
            assert lease.state(now_s) is expected, sequence
            assert (lease.owner is owner) and lease.is_free(now_s) == (
                expected in (State.FREE, State.SILENT)
            )
