import contextlib

import pytest
from pymavlink import mavutil
from twisted.internet.task import Clock

from tests.ground import aircraft
from tests.ground.aircraft import Aircraft, Ground, codes, ground
from tests.proxy.program import Client
from tests.support.waiting import until
from up.protocols.general_message import GeneralMessage
from up_ground.link_status import LinkState
from up_ground.mavlink_bridge import MAVLinkBridge
from up_ground.settings import Settings
from up_ground.token_store import TokenStore
from up_mavlink.address import read_address
from up_mavlink.endpoint import Settings as EndpointSettings
from up_mavlink.personas import BY_NAME

ARM = 400
ACCEPTED, DENIED = 0, 2


class Station:
    """A MAVLink ground station on the bridge's TCP port."""

    def __init__(self, bridge):
        bridge.expect("mavlink_open")
        port = bridge.event("mavlink_open")["port"]
        self.link = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}", source_system=255)
        self.got = []

    def command(self, number, *params, is_done=lambda result: True):
        """Send a command until its result is as it should be; return the result."""

        def result():
            self.link.mav.heartbeat_send(6, 8, 0, 0, 4)
            given = [*params, *[0.0] * (7 - len(params))]
            self.link.mav.command_long_send(1, 1, number, 0, *given)
            while message := self.link.recv_match(blocking=True, timeout=1.0):
                self.got.append(message)
                if message.get_type() == "COMMAND_ACK":
                    return (message.result,) if is_done(message.result) else None
            return None

        return until(result, "a result")[0]

    @property
    def texts(self):
        return "".join(each.text for each in self.got if each.get_type() == "STATUSTEXT")


@contextlib.contextmanager
def bridged(proxy, folder, *options):
    with (
        Aircraft(proxy.airborne_port) as flying,
        Ground(folder, proxy.ground_port, "mavlink", "tcpin:127.0.0.1:0", *options) as bridge,
    ):
        station = Station(bridge)
        yield flying, station
        station.link.close()


def test_the_station_commands_while_it_is_there(proxy, tmp_path):
    with bridged(proxy, tmp_path) as (flying, station):
        assert station.command(ARM, 1, is_done=lambda result: result == ACCEPTED) == ACCEPTED
        arming = [each for each in flying.received if each["name"] == "up.arm"]
        assert abs(arming[-1]["beacon"] - flying.beacon) < 100
        position = station.link.recv_match(type="GLOBAL_POSITION_INT", blocking=True, timeout=30)
        assert (position.lat, position.alt) == (500755000, 312000)
        station.link.close()

        def is_free():
            hello = f"UP1 aircraft={aircraft.NAME} seat=command\n"
            with Client(proxy.ground_port, hello) as other:
                return "seat=command" in other.line()

        until(is_free, "control")


def test_nothing_is_carried_out_while_another_ground_has_control(proxy, owner, tmp_path):
    with bridged(proxy, tmp_path) as (flying, station):
        assert station.command(ARM, 1) == DENIED
        until(lambda: station.command(ARM, 1) == DENIED and "has control" in station.texts, "why")
        assert flying.received == []


def test_a_bridge_that_watches_commands_nothing(proxy, tmp_path):
    with bridged(proxy, tmp_path, "--watch-only") as (flying, station):
        assert station.command(ARM, 1) == DENIED
        assert flying.received == []


@pytest.mark.parametrize("is_watching", [False, True])
def test_a_direct_link_has_no_lease_and_still_only_watches(is_watching, tmp_path):
    settings = Settings(direct=True)
    served = EndpointSettings(read_address("udpin:127.0.0.1:0"), BY_NAME["ardupilot"])
    tokens = TokenStore(tmp_path, settings)
    reactor = Clock()
    bridge = MAVLinkBridge(reactor, settings, tokens, served, is_watching=is_watching)
    bridge.link.status.state = LinkState.OPEN
    assert bridge.problem
    bridge.telemetry.update(GeneralMessage("up.telemetry.update", {}, None, 1), 0.0)
    assert bool(bridge.problem) is is_watching
    reactor.advance(2.0)
    assert bridge.problem


@pytest.mark.parametrize(
    ("url", "code"), [("udpin:0.0.0.0:0", "unsigned"), ("tcpin:192.0.2.1:5760", "unsigned")]
)
def test_strangers_could_not_use_it(url, code, tmp_path):
    status, _, stderr = ground(tmp_path, 1, "mavlink", url)
    assert (status, codes(stderr)) == (2, [code])
