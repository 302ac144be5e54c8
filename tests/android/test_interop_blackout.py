"""15 s without a radio for the Java phone and the Java ground together: late data is dropped."""

import time

import pytest

from tests.android.console_program import ConsoleProgram, number_in
from tests.android.far_network import HERE, FarNetwork
from tests.android.java_process import resident_bytes
from tests.android.numbered_motion import numbers_of
from tests.android.phone_program import PhoneProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.proxy.program import Program
from tests.support.waiting import until

DARK_S = 15.0
"""Longer than every limit of silence and the proxy's hold of the seat."""
FRESH_S = 3.0
STALE_S = 2.0
"""No Command older than this is executed, and no telemetry of that age delivered."""
MOST_GROWTH = 5_000_000


class System:
    """Aircraft and proxy here; the phone and a ground behind the radio; another ground here."""

    def __init__(self, folder, radio):
        self.proxy = Program(folder / "proxy")
        self.proxy.__enter__()
        self.daemon = RealDaemon(folder / "daemon", self.proxy)
        self.daemon.start()
        proxy = ("--proxy", f"{HERE}:{self.proxy.ground_port}", "--aircraft", AIRCRAFT)
        self.far = ConsoleProgram(*proxy, prefix=radio.prefix)
        self.far.holds()
        here = (f"127.0.0.1:{self.proxy.ground_port}", "--aircraft", AIRCRAFT, "--seat", "listen")
        self.near = ConsoleProgram("--proxy", *here)
        place = self.daemon.place_at(HERE)
        self.phone = PhoneProgram(*place, "--orientation", "tcp", prefix=radio.prefix)
        self.far.until(lambda: self.far.number(), "an attitude")

    def end(self):
        for each in (self.phone, self.far, self.near, self.daemon, self.proxy):
            each.end()

    def memory(self):
        """Return the bytes that each program uses."""
        return {
            "phone": self.phone.live_bytes(), "ground": self.far.live_bytes(),
            "daemon": resident_bytes(self.daemon.process.pid),
            "proxy": resident_bytes(self.proxy.pid),
        }  # fmt: skip


@pytest.fixture
def radio():
    with FarNetwork(delay_s=0.03) as made:
        yield made


@pytest.fixture
def system(tmp_path, radio):
    made = System(tmp_path, radio)
    yield made
    made.end()


def test_fifteen_seconds_of_darkness(system, radio):
    far, near, phone, ground = system.far, system.near, system.phone, system.daemon.ground
    assert far.ask("black_box.mark", text="light")["outcome"] == "ACK"
    before = system.memory()
    # Commands sent during the outage are answered during it, and never executed.
    dark_s = time.monotonic()
    radio.is_dark = True
    sent = [far.ask_later("black_box.mark", text="dark 0")]
    far.until(lambda: far.answer(sent[0]), "the outcome of the first")
    assert far.answer(sent[0])["outcome"] == "TIMEOUT"
    assert ground.ask("android.speak", text="dark"), "the daemon says why not"
    sent.append(far.ask_later("black_box.mark", text="dark 1"))
    far.until(lambda: far.status["link"] != "OPEN", "the ground misses the aircraft")
    phone.until(lambda: phone.all("lost"), "the phone misses the aircraft")
    missed_s = time.monotonic() - dark_s
    ground.sees("the aircraft misses the phone", android__connected=False)
    sent.append(far.ask_later("black_box.mark", text="dark 2"))
    until(lambda: time.monotonic() >= dark_s + DARK_S, "the end of the night")
    assert not far.all("telemetry", dark_s + 1), "no frame came in it"
    radio.is_dark = False
    light_s = time.monotonic()
    said = phone.number

    def fresh_number():
        numbers = [number_in(frame) for frame in far.all("telemetry", light_s)]
        return any(number is not None and number > said for number in numbers)

    far.until(lambda: far.all("telemetry", light_s), "telemetry")
    telemetry_s = time.monotonic() - light_s
    phone.until(lambda: phone.all("connected", light_s), "the phone's link")
    phone_s = time.monotonic() - light_s
    far.until(fresh_number, "an attitude that the phone said in the light")
    attitude_s = time.monotonic() - light_s
    print(f"blackout: missed by both after {missed_s:.1f} s; back after {telemetry_s:.2f} s"
          f" (telemetry), {phone_s:.2f} s (phone), {attitude_s:.2f} s (attitude)")  # fmt: skip
    # The disconnected owner has the seat again, and its Commands are executed.
    far.holds()
    assert far.ask("black_box.mark", text="light again")["outcome"] == "ACK"
    assert far.ask("android.speak", text="good morning")["outcome"] == "ACK"
    assert phone.said == ["good morning"]
    for tag in sent:
        far.until(lambda tag=tag: far.answer(tag), "the outcome of each")
        assert far.answer(tag)["outcome"] in ("TIMEOUT", "LOST", "REFUSED")
    grown = {name: after - before[name] for name, after in system.memory().items()}
    oldest_ms = oldest(near, far, light_s)
    print(f"oldest frame after it {oldest_ms:.0f} ms, grown {grown}")
    assert oldest_ms < STALE_S * 1000
    assert all(bytes_ < MOST_GROWTH for bytes_ in grown.values()), grown
    assert max(telemetry_s, phone_s, attitude_s) < FRESH_S
    assert system.daemon.end() == 0
    marks = [data["text"] for _, data in system.daemon.log_of("black_box.mark")]
    assert marks == ["light", "light again"]
    numbers_of(system.daemon.log_of("up.orientation.update"))


def oldest(near, far, since_s):
    """Return the age, ms, of the oldest frame that came since a moment, by one clock."""
    made_s = {said["beacon"]: at for at, said in list(near.events) if said["event"] == "telemetry"}
    came = [(at, said["beacon"]) for at, said in list(far.events)
            if said["event"] == "telemetry" and at >= since_s]  # fmt: skip
    told = [(at - made_s[beacon]) * 1000 for at, beacon in came if beacon in made_s]
    assert len(told) > len(came) / 2
    return max(told)
