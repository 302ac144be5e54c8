"""A seat and its rules."""

from dataclasses import dataclass

from up_proxy.seat import ALIVE_S, Seat


@dataclass
class Someone:
    heard_s: float = 0.0


def test_an_empty_seat_is_free():
    seat = Seat()
    assert seat.is_free(0.0)
    assert seat.holder(0.0) is None
    assert not seat.is_resumed_by("x")


def test_a_held_seat_is_free_only_when_its_holder_has_been_silent():
    seat, holder = Seat(), Someone(heard_s=10.0)
    assert seat.take(holder, "t") is None
    assert not seat.is_free(10.0 + ALIVE_S)
    assert seat.is_free(10.01 + ALIVE_S)
    holder.heard_s = 20.0
    assert not seat.is_free(20.0)
    assert seat.holder(20.0) is holder


def test_its_token_takes_a_seat_over_at_once_and_no_other():
    seat = Seat()
    seat.take(Someone(), "secret")
    assert seat.is_resumed_by("secret")
    assert not seat.is_resumed_by("secreT")
    assert not seat.is_resumed_by(None)
    assert not seat.is_resumed_by("")


def test_a_holder_that_left_is_waited_for():
    seat, holder = Seat(), Someone(heard_s=10.0)
    seat.take(holder, "t")
    seat.leave()
    assert seat.holder(10.0) is None
    assert not seat.is_free(10.0 + ALIVE_S)
    assert seat.is_free(10.01 + ALIVE_S)
    assert seat.is_resumed_by("t")


def test_a_released_seat_is_free_at_once_and_its_token_worthless():
    seat = Seat()
    seat.take(Someone(heard_s=10.0), "t")
    seat.release()
    assert seat.is_free(10.0)
    assert not seat.is_resumed_by("t")


def test_a_new_holder_ends_the_old_token():
    seat, old, new = Seat(), Someone(), Someone()
    seat.take(old, "old")
    assert seat.take(new, "new") is old
    assert not seat.is_resumed_by("old")


def test_a_holder_without_a_token_is_not_resumed():
    seat = Seat()
    seat.take(Someone(heard_s=10.0), None)
    assert not seat.is_resumed_by(None)
    seat.leave()
    assert seat.is_free(10.0)
