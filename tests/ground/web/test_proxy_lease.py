from types import SimpleNamespace

import pytest

from up_ground.link_status import ControlStatus, LinkState, LinkStatus
from up_ground.settings import Seat
from up_ground.web.proxy_lease import ProxyLease


@pytest.fixture
def link():
    status = LinkStatus(state=LinkState.OPEN, seat=Seat.COMMAND, holder=3, is_holder_known=True)
    sent = []
    return SimpleNamespace(
        status=status,
        sent=sent,
        release_seat=lambda: sent.append("release"),
        request_seat=lambda: sent.append("request"),
        give_seat=lambda to: sent.append(f"give {to}"),
    )


def test_a_seat_that_was_left_is_not_ours_though_the_proxy_has_not_said_so(link):
    seat = ProxyLease(link, is_direct=False)
    assert seat.status is ControlStatus.OURS
    seat.release()
    assert seat.status is ControlStatus.LATER


def test_a_seat_that_nobody_took_is_still_ours(link):
    seat = ProxyLease(link, is_direct=False)
    seat.give(4)
    assert seat.status is ControlStatus.OURS


def test_a_seat_that_was_left_is_asked_for_anew(link):
    seat = ProxyLease(link, is_direct=False)
    seat.release()
    seat.request()
    assert link.sent == ["release", "request"]
    link.status.seat, link.status.holder = Seat.LISTEN, None
    assert seat.status is ControlStatus.FREE
    link.status.seat = Seat.COMMAND
    assert seat.status is ControlStatus.OURS


def test_a_link_that_was_lost_meanwhile_leaves_nothing_of_it(link):
    seat = ProxyLease(link, is_direct=False)
    seat.release()
    link.status.disconnected(LinkState.WAITING, 1.0)
    assert seat.status is ControlStatus.UNKNOWN
    link.status.state, link.status.seat = LinkState.OPEN, Seat.COMMAND
    assert seat.status is ControlStatus.OURS


def test_a_direct_link_is_always_ours(link):
    seat = ProxyLease(link, is_direct=True)
    seat.release()
    assert seat.status is ControlStatus.OURS
