"""The Java ground at the real proxy, daemon and firmware: telemetry, gains, arming, the phone."""

import statistics
import time

import pytest

from tests.android.console_program import ConsoleProgram
from tests.android.far_network import HERE, FarNetwork
from tests.android.phone_program import PhoneProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.android.slow_relay import SlowRelay
from tests.cogs.arduino_cog.bench_board import BenchBoard
from tests.proxy.program import Client, Program
from tests.support.firmware import build_firmware
from tests.support.waiting import until

VALUES = ("armed", "flight_mode", "arduino.connected", "arduino.switch", "servo.ailerons")
WAY_S = 0.15


class System:
    """The firmware on the bench, the daemon, the proxy, and a Java ground that commands."""

    def __init__(self, folder):
        self.board = BenchBoard(build_firmware(), folder / "board", {"aux1": 1000, "aux2": 1000})
        self.proxy = Program(folder / "proxy")
        self.daemon = self.console = None
        self.folder = folder

    def start(self):
        self.board.fly()
        self.proxy.__enter__()
        self.daemon = RealDaemon(self.folder / "daemon", self.proxy, self.board.link)
        ground = self.daemon.start()
        ground.sees("the Arduino", arduino__connected=True, armed=False)
        self.await_profile()

    def await_profile(self):
        ground = self.daemon.ground
        self.board.wait(
            lambda: not any("airframe.yml" in veto for veto in ground.at("vetoes")), "the profile"
        )

    def to_the_ground(self, port=None, host="127.0.0.1"):
        return ("--proxy", f"{host}:{port or self.proxy.ground_port}", "--aircraft", AIRCRAFT)

    def command(self):
        """Let a Java ground take the seat."""
        self.console = ConsoleProgram(*self.to_the_ground(), values=VALUES)
        self.console.holds()
        return self.console

    def end(self):
        for each in (self.console, self.daemon, self.proxy, self.board):
            if each is not None:
                each.end()


@pytest.fixture(scope="module")
def system(tmp_path_factory):
    made = System(tmp_path_factory.mktemp("ground"))
    try:
        made.start()
        yield made
    finally:
        made.end()


@pytest.fixture(scope="module")
def console(system):
    """The console of all the tests; the one that wants a free seat comes before."""
    return system.console or system.command()


def test_arming_without_a_beacon_is_refused_at_both_ends(system):
    hello = f"UP1 aircraft={AIRCRAFT} seat=command\n"
    with Client(system.proxy.ground_port, hello) as client:
        client.expect("seat=command")
        client.say('{"name": "up.arm", "data": {}, "id": "a"}\n')
        assert '"code": "no_beacon"' in client.expect('"id": "a"')
        client.say("UP1 seat release\n")
        client.expect("holder=none")
    # The Java ground sends nothing where it has seen nothing of the aircraft.
    with Client(system.proxy.airborne_port, "UP1 aircraft=mute\n") as mute:
        mute.expect("UP1 ok")
        to_mute = ("--proxy", f"127.0.0.1:{system.proxy.ground_port}", "--aircraft", "mute")
        with ConsoleProgram(*to_mute) as console:
            console.until(lambda: console.status.get("standing") == "OURS", "the seat")
            # It runs but sends nothing: the proxy drops a peer that is silent for 3 s.
            console.until(lambda: mute.say("\n") and console.status["online"], "the aircraft")
            refused = console.ask("up.arm")
            assert (refused["outcome"], refused["code"]) == ("REFUSED", "no_beacon")
        mute.socket.settimeout(0.2)
        assert not has_come(mute, b"up.arm")


def test_hello_seat_and_telemetry_by_a_handler(system, console):
    assert console.status["link"] == "OPEN" and console.status["seat"] == "command"
    console.until(lambda: console.status["role"] == "pilot", "the role")
    assert console.status["tune_in_flight"] is False
    console.sees("the Arduino", arduino__connected=True, armed=False, arduino__switch="low")
    beacons = [frame["beacon"] for frame in console.frames]
    assert beacons == sorted(beacons) and len(set(beacons)) == len(beacons)
    # The stick moves a servo, and the ground sees it.
    system.board.move(ailerons=1700)
    console.until(lambda: abs((console.at("servo.ailerons") or 0) - 1700) <= 3, "the servo")
    system.board.move(ailerons=1500)


def test_the_period_of_telemetry_is_the_grounds_wish(console):
    def mean_ms(count=20):
        begun = len(console.events)
        times = []

        def came():
            times[:] = [at for at, said in console.events[begun:] if said["event"] == "telemetry"]
            return len(times) > count

        console.until(came, "frames")
        return (times[-1] - times[0]) / (len(times) - 1) * 1000

    assert console.ask("up.telemetry.frequency", frequency=400)["outcome"] == "ACK"
    slow_ms = mean_ms(6)
    assert console.ask("up.telemetry.frequency", frequency=50)["outcome"] == "ACK"
    quick_ms = mean_ms()
    assert slow_ms > 300 and quick_ms < 200
    wrong = console.ask("up.telemetry.frequency", frequency=5)
    assert (wrong["outcome"], wrong["code"]) == ("NACK", "invalid")


def test_gains_with_ack_fly_in_the_firmware_and_an_undo_brings_the_old_back(system, console):
    console.until(lambda: console.all("gains"), "the gains by themselves")
    before = console.all("gains")[-1]["flying"]
    wanted = {loop: {axis: dict(pid) for axis, pid in axes.items()}
              for loop, axes in before.items()}  # fmt: skip
    wanted["ratePIDs"]["ailerons"] = {"p": 3.25, "i": 0.5, "d": 0.125}
    assert wanted != before
    answer = console.gains(wanted)
    assert answer["outcome"] == "ACK", answer
    console.until(lambda: console.all("gains")[-1]["flying"] == wanted, "them at the Java ground")
    # The firmware's values, read back by another ground.
    ground = system.daemon.ground
    del ground.messages[:]
    assert ground.ask("arduino.pids.tunings", request=True) == ""
    assert ground.content("arduino.pids.values")["ratePIDs"] == wanted["ratePIDs"]
    assert console.gains("undo")["outcome"] == "ACK"
    console.until(lambda: console.all("gains")[-1]["flying"] == before, "the old ones")
    too_much = {**wanted, "ratePIDs": {**wanted["ratePIDs"], "ailerons": {"p": 51, "i": 0, "d": 0}}}
    console.say(gains=too_much, tag="much")
    console.until(lambda: console.all("notice"), "the bound")
    assert console.all("notice")[-1]["code"] == "invalid_input"


def test_arming_with_the_beacon_and_no_gains_in_flight(system, console):
    board, ground = system.board, system.daemon.ground
    refused = console.ask("up.arm")
    assert (refused["outcome"], refused["code"]) == ("NACK", "refused")
    # The firmware arms on an edge that follows 300 ms of low.
    board.pass_us(400_000)
    board.move(aux2=2000)
    console.sees("armed by AUX2", armed=True)
    flying = console.all("gains")[-1]["flying"]
    refused = console.gains({**flying, "ratePIDs": {
        axis: {**pid, "p": pid["p"] + 1} for axis, pid in flying["ratePIDs"].items()}})  # fmt: skip
    assert (refused["outcome"], refused["code"]) == ("NACK", "forbidden")
    board.pass_us(2_300_000)
    assert console.ask("up.disarm")["outcome"] == "ACK"
    console.sees("disarmed by the ground", armed=False)
    armed = console.ask("up.arm")
    assert armed["outcome"] == "ACK", armed
    console.sees("armed by the ground, with its beacon", armed=True)
    board.move(aux2=1000)
    ground.sees("disarmed by AUX2", armed=False)


def test_the_phone_speaks_what_the_ground_says(system, console):
    with PhoneProgram(*system.daemon.place) as phone:
        phone.connected()
        answer = console.ask("android.speak", text="trees: \u00e4 \u6a39")
        assert answer["outcome"] == "ACK", answer
        assert phone.said == ["trees: \u00e4 \u6a39"]
    system.daemon.ground.sees("no phone", android__connected=False)
    answer = console.ask("android.speak", text="anybody there?")
    assert (answer["outcome"], answer["code"]) == ("NACK", "unavailable")


def test_ages_are_honest_behind_a_slow_link(system, console):
    """True ages are those by a ground beside the aircraft, on one clock with the far one."""
    near = console
    with FarNetwork(WAY_S) as link:
        listens = (*system.to_the_ground(host=HERE), "--seat", "listen")
        with ConsoleProgram(*listens, prefix=link.prefix) as far:
            far.seated("listen")
            far.until(lambda: len(far.frames) > 30, "frames")
            quick = compare(near, far, 20)
            link.delay_s = 0.5
            begun = len(far.frames)
            far.until(lambda: len(far.frames) > begun + 40, "frames of the slower link")
            slow = compare(near, far, 15)
            assert all(frame["way_ms"] >= 1000 * WAY_S for frame in far.frames)
            assert far.ask("up.disarm")["code"] == "no_control"
    # Two programs on a loaded machine read late, which the true age includes and the told one not.
    noise_ms = 120
    for (true_ms, told_ms), way_ms in ((quick, 1000 * WAY_S), (slow, 500)):
        assert way_ms - noise_ms <= true_ms, (quick, slow)
        assert way_ms <= told_ms <= true_ms + noise_ms, (quick, slow)
    print(f"ages, true and told: {quick}, on the slower link {slow} ms")


def compare(near, far, count):
    """Return the medians of the newest frames' ages: the true ones and those of the far ground."""
    came_s = {said["beacon"]: at for at, said in list(near.events) if said["event"] == "telemetry"}
    told = [(at, said) for at, said in list(far.events) if said["event"] == "telemetry"][-count:]
    both = [((at - came_s[said["beacon"]]) * 1000, said["age_ms"])
            for at, said in told if said["beacon"] in came_s]  # fmt: skip
    assert len(both) > count / 2
    return tuple(round(statistics.median(column)) for column in zip(*both, strict=True))


def test_gains_over_a_link_of_300_ms(system, console):
    """The seat is handed over to the far ground, which then is the one that sets gains."""
    with (
        SlowRelay(system.proxy.ground_port, WAY_S) as relay,
        ConsoleProgram(*system.to_the_ground(relay.port)) as far,
    ):
        far.seated("listen")
        far.say(seat="request")
        console.until(lambda: console.status.get("asked_by"), "that it is asked")
        console.say(seat={"give": console.status["asked_by"]})
        far.holds()
        console.until(lambda: console.status["seat"] == "listen", "that it listens now")
        assert console.ask("up.disarm")["code"] == "no_control"
        far.until(lambda: far.all("gains"), "the gains by themselves")
        flying = far.all("gains")[-1]["flying"]
        rate = {axis: {**pid, "d": 0.25} for axis, pid in flying["ratePIDs"].items()}
        answer = far.gains({**flying, "ratePIDs": rate})
        assert answer["outcome"] == "ACK", answer
        assert answer["round_trip_ms"] >= 2000 * WAY_S
        far.until(lambda: far.all("gains")[-1]["flying"]["ratePIDs"] == rate, "them")
        print(f"gains over 300 ms: ack after {answer['round_trip_ms']} ms")
        console.say(seat="request")
        far.until(lambda: far.status.get("asked_by"), "that it is asked")
        far.say(seat={"give": far.status["asked_by"]})
        console.holds()
    assert console.ask("up.telemetry.frequency", frequency=100)["outcome"] == "ACK"


def test_the_seat_comes_back_by_its_token_after_a_cut(system, console):
    """A listener waits for the seat; the disconnected owner gets it back before it is released."""
    console.say(seat="release")
    console.until(lambda: console.status["standing"] != "OURS", "that it is left")
    with (
        SlowRelay(system.proxy.ground_port) as relay,
        ConsoleProgram(*system.to_the_ground(relay.port)) as pilot,
    ):
        pilot.holds()
        console.say(seat="request")
        for cut in range(1, 4):
            cut_s = time.monotonic()
            relay.cut(1)
            until(lambda cut=cut: relay.cuts == cut, "the cut")
            pilot.until(lambda at=cut_s: links(pilot, at)[-1:] == ["WAITING"], "the loss")
            pilot.until(lambda at=cut_s: links(pilot, at)[-1:] == ["OPEN"], "the next one")
            pilot.until(lambda: pilot.status["seat"], "its seat")
        pilot.holds()
        seats = {each["seat"] for each in pilot.all("status")}
        assert "listen" not in seats, "its token regains control immediately"
        assert pilot.ask("up.telemetry.frequency", frequency=100)["outcome"] == "ACK"
        pilot.say(seat="release")
        console.until(lambda: console.status["standing"] == "FREE", "that it is free")
        console.say(seat="request")
        console.holds()


def links(console, since_s):
    """Return the states of a console's link since a moment."""
    return [each["link"] for each in console.all("status", since_s)]


def has_come(client, word):
    """Return whether a word is in what waits to be read."""
    try:
        return word in client.socket.recv(65536)
    except TimeoutError:
        return False
