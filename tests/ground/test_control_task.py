from tests.ground import aircraft
from tests.ground.aircraft import Aircraft, Ground, codes, ground
from tests.proxy.program import Client


def test_free_control_is_granted_immediately(proxy, tmp_path):
    status, said, _ = ground(tmp_path, proxy.ground_port, "control", "request")
    assert (status, codes(said)) == (0, ["control_granted"])


def test_the_owner_gives_control(proxy, owner, tmp_path):
    with Ground(tmp_path, proxy.ground_port, "control", "request") as asking:
        number = owner.expect("UP1 seat asked by=").strip().rpartition("=")[2]
        asking.expect("control_requested")
        assert asking.event("control_requested")["owner"] == 1
        owner.say(f"UP1 seat give to={number}\n")
        assert asking.wait() == 0
    assert asking.event("control_granted")


def test_an_owner_that_does_not_give_control_is_named(proxy, owner, tmp_path):
    status, _, stderr = ground(tmp_path, proxy.ground_port, "control", "request", "--wait", "1")
    assert (status, aircraft.coded(stderr)) == (3, [{"code": "not_granted", "owner": 1}])


def test_control_is_handed_to_a_listener(proxy, listener, tmp_path):
    with Aircraft(proxy.airborne_port) as flying:
        status, said, stderr = ground(tmp_path, proxy.ground_port, "control", "give", "1")
        assert (status, codes(said)) == (0, ["control_given"]), stderr
        listener.expect("UP1 seat command token=")
        listener.say('{"name": "up.disarm", "id": "x"}\n')
        listener.expect('{"name": "up.ack", "data": {"id": "x"}}')
    assert flying.received[0]["name"] == "up.disarm"


def test_control_cannot_be_handed_to_an_unknown_ground(proxy, tmp_path):
    status, _, stderr = ground(tmp_path, proxy.ground_port, "control", "give", "99")
    assert (status, codes(stderr)) == (1, ["unknown_ground"])


def test_released_control_is_free_and_its_token_deleted(proxy, tmp_path):
    assert ground(tmp_path, proxy.ground_port, "seat", "request")[0] == 0
    status, said, _ = ground(tmp_path, proxy.ground_port, "control", "release")
    assert (status, codes(said)) == (0, ["control_released"])
    assert list((tmp_path / "state" / "up-ground").glob("*.token")) == []
    with Client(proxy.ground_port, f"UP1 aircraft={aircraft.NAME} seat=command\n") as other:
        other.expect("seat=command")


def test_a_ground_without_control_cannot_release_it(proxy, owner, tmp_path):
    status, _, stderr = ground(tmp_path, proxy.ground_port, "control", "release")
    assert (status, codes(stderr)) == (1, ["no_control"])


def test_a_direct_link_has_no_control(tmp_path):
    status, _, stderr = ground(tmp_path, 1, "--direct", "control", "request")
    assert (status, codes(stderr)) == (2, ["direct"])
