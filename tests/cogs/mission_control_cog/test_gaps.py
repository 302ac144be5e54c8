"""Networks that swallow packets and proxies that die: real proxy, real packets."""

import time

from tests.cogs.mission_control_cog.system import Aircraft
from tests.cogs.peers import connect
from tests.proxy.namespace import THERE, blackhole, light, network
from tests.proxy.program import Program
from tests.support.reactor import reactor, sleep, until
from up_ground.ground_link import GroundLink
from up_ground.settings import Seat, Settings
from up_ground.telemetry import LATE_S, Telemetry
from up_ground.token_store import TokenStore

BLACKOUT_S = 8.0
OPEN = "i_accept_plain: true\n"


class Ages:
    """Of every frame that reaches the ground: how old it was then, seconds."""

    def __init__(self, up, ground):
        self.up = up
        self.ground = ground
        self.seen = 0
        self.worst_s = 0.0

    def look(self):
        frames = self.ground.named("up.telemetry.update")
        for frame in frames[self.seen :]:
            age_s = self.up.beacons.age_s(frame["beacon"])
            self.worst_s = max(self.worst_s, 1e9 if age_s is None else age_s)
        new, self.seen = len(frames) - self.seen, len(frames)
        return new


class GroundStation:
    """The link and the telemetry of up-ground; ``shown`` has beacon and age of each frame, s."""

    def __init__(self, up, port, folder):
        settings = Settings(THERE, port, "default", Seat.LISTEN)
        self.up = up
        self.telemetry = Telemetry()
        self.link = GroundLink(reactor, settings, self, TokenStore(folder, settings))
        self.came = self.shown = ()

    def on_link(self):
        pass

    def on_message(self, message):
        if message.beacon is None:
            return
        frame = (message.beacon, self.up.beacons.age_s(message.beacon))
        self.came += (frame,)
        if self.telemetry.update(message, reactor.seconds()):
            self.shown += (frame,)


async def watch(ages, seconds):
    """Watch the received data for some time."""
    end_s = reactor.seconds() + seconds
    while reactor.seconds() < end_s:
        ages.look()
        await sleep(0.01)


async def seated(port):
    ground = await connect(reactor, port, THERE)
    ground.say(b"UP1 aircraft=default seat=command\n")
    await until(lambda: b"UP1 ok" in ground.received)
    return ground


async def test_after_a_blackout_fresh_data_come_and_no_stale_frame(tmp_path):
    with network() as inside, Program(tmp_path / "p", OPEN, prefix=inside) as proxy:
        async with Aircraft(tmp_path / "a", proxy.airborne_port, host=THERE) as a:
            ground = await seated(proxy.ground_port)
            ages = Ages(a.up, ground)
            await until(ages.look)
            blackhole(inside)
            # The ground loses its link too; it reconnects automatically, as the aircraft does.
            await sleep(BLACKOUT_S)
            assert not a.provider.connected
            light(inside)
            back_s = reactor.seconds()
            again = await seated(proxy.ground_port)
            ages_after = Ages(a.up, again)
            await until(ages_after.look, 10)
            assert reactor.seconds() - back_s <= 3.5
            await watch(ages_after, 1.0)
            # A frame is in transit for milliseconds here; a second is a backlog.
            assert ages_after.worst_s < 1.0
            assert a.provider.telemetry_content["counters"]["mission_control"]["connects"] == 2
            for each in (ground, again):
                await each.close()


async def test_a_gap_of_one_second_is_ridden_through(tmp_path):
    with network() as inside, Program(tmp_path / "p", OPEN, prefix=inside) as proxy:
        async with Aircraft(tmp_path / "a", proxy.airborne_port, host=THERE) as a:
            ground = await seated(proxy.ground_port)
            ages = Ages(a.up, ground)
            await until(ages.look)
            blackhole(inside)
            await sleep(0.8)
            light(inside)
            await until(ages.look, 10)
            await watch(ages, 1.0)
            # TCP delivers in order the data sent before it noticed the gap, however old.
            assert ages.worst_s < 3.0
            await ground.close()


async def test_after_a_cut_of_one_second_no_late_frame_is_shown(tmp_path, monkeypatch):
    # As in the programs; frames carry their sender's monotonic time.
    monkeypatch.setattr(reactor, "seconds", time.monotonic)
    with network() as inside, Program(tmp_path / "p", OPEN, prefix=inside) as proxy:
        async with Aircraft(tmp_path / "a", proxy.airborne_port, host=THERE) as a:
            ground = GroundStation(a.up, proxy.ground_port, tmp_path)
            ground.link.start()
            try:
                await until(lambda: len(ground.shown) > 3)
                before = len(ground.shown)
                blackhole(inside)
                await sleep(1.0)
                light(inside)
                await until(lambda: len(ground.shown) > before + 5, 10)
            finally:
                await ground.link.stop()
            connects = a.provider.telemetry_content["counters"]["mission_control"]["connects"]
            assert connects == 1
            late = [age_s for _, age_s in ground.came if age_s > LATE_S]
            # Those that left in the 200 ms before the kernel repeats one, and one of the proxy.
            assert 1 <= len(late) <= 5
            # Two clocks and the reactor's own lateness are in the age.
            assert max(age_s for _, age_s in ground.shown) < LATE_S + 0.2


async def test_a_proxy_that_restarts_is_found_again(tmp_path):
    with Program(tmp_path / "p") as first:
        ports = (first.airborne_port, first.ground_port, 0)
        async with Aircraft(tmp_path / "a", ports[0]) as a:
            await until(lambda: a.provider.connected)
            first.process.kill()
            await until(lambda: not a.provider.connected)
            second = Program(tmp_path / "q", ports=ports)
            try:
                await until(lambda: second.is_up() and a.provider.connected)
                ground = await connect(reactor, ports[1])
                ground.say(b"UP1 aircraft=default seat=command\n")
                frames = await until(lambda: ground.named("up.telemetry.update"))
                assert a.up.beacons.age_s(frames[0]["beacon"]) < 2
                await ground.close()
            finally:
                second.end()
