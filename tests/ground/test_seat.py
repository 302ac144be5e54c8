"""`up-ground seat`: who commands."""

from tests.ground.aircraft import Aircraft, Ground, ground
from tests.proxy.program import Client


def test_a_free_seat_is_given_at_once(proxy, tmp_path):
    status, said, _ = ground(tmp_path, proxy.ground_port, "seat", "request")
    assert (status, said) == (0, "this ground commands now\n")


def test_the_holder_is_asked_and_gives(proxy, tmp_path):
    with Client(proxy.ground_port, "UP1 aircraft=default seat=command\n") as holder:
        holder.expect("seat=command")
        with Ground(tmp_path, proxy.ground_port, "seat", "request") as asking:
            number = holder.expect("UP1 seat asked by=").strip().rpartition("=")[2]
            asking.expect("asked ground 1, which commands")
            holder.say(f"UP1 seat give to={number}\n")
            assert asking.wait() == 0
        assert "this ground commands now" in asking.said


def test_a_holder_that_does_not_give_is_named(proxy, tmp_path):
    with Client(proxy.ground_port, "UP1 aircraft=default seat=command\n") as holder:
        holder.expect("seat=command")
        status, _, stderr = ground(tmp_path, proxy.ground_port, "seat", "request", "--wait", "1")
    assert status == 3
    assert stderr == "up-ground: no seat within 1 s: ground 1 has not given it\n"


def test_it_is_handed_to_a_listener(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port) as aircraft,
        Client(proxy.ground_port, "UP1 aircraft=default seat=listen\n") as heir,
    ):
        heir.expect("seat=listen")
        status, said, stderr = ground(tmp_path, proxy.ground_port, "seat", "give", "1")
        assert (status, said) == (0, "the seat is ground 1's now\n"), stderr
        heir.expect("UP1 seat command token=")
        heir.say('{"name": "up.disarm", "id": "x"}\n')
        heir.expect('{"name": "up.ack", "data": {"id": "x"}}')
    assert aircraft.received[0]["name"] == "up.disarm"


def test_it_cannot_be_handed_to_nobody(proxy, tmp_path):
    status, _, stderr = ground(tmp_path, proxy.ground_port, "seat", "give", "99")
    assert status == 1
    assert stderr == "up-ground: no ground 99 listens to this aircraft\n"


def test_it_is_left_free_and_its_token_forgotten(proxy, tmp_path):
    assert ground(tmp_path, proxy.ground_port, "seat", "request")[0] == 0
    status, said, _ = ground(tmp_path, proxy.ground_port, "seat", "release")
    assert (status, said) == (0, "the seat is free now\n")
    assert list((tmp_path / "state" / "up-ground").glob("*.token")) == []
    with Client(proxy.ground_port, "UP1 aircraft=default seat=command\n") as other:
        other.expect("seat=command")


def test_who_has_no_seat_cannot_leave_it(proxy, tmp_path):
    with Client(proxy.ground_port, "UP1 aircraft=default seat=command\n") as holder:
        holder.expect("seat=command")
        status, _, stderr = ground(tmp_path, proxy.ground_port, "seat", "release")
    assert status == 1
    assert stderr == "up-ground: this ground has no seat to leave: ground 1 commands\n"


def test_a_direct_link_has_none(tmp_path):
    status, _, stderr = ground(tmp_path, 1, "--direct", "seat", "request")
    assert (status, stderr) == (2, "up-ground: a direct link has no seats\n")
