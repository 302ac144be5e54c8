"""The gains: the Arduino's are the truth, pids.yml their copy."""

import struct

import pytest
from arduino_cog.modules.pid_tunings_provider import PIDTuningsProvider
from twisted.internet.defer import maybeDeferred

from tests.cogs.arduino_cog.board import FACTORY, PUSHED, Ground
from up.commands.gains import gain_set_to_data
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_controller.pids_file import PIDS, PidsFile
from up.system.disk_thread import DiskThread

GOOD = PIDS.template()
AXES = ("ailerons", "elevator", "rudder")
# The gains of the template, in the order of `g`.
SAVED = (2.0, 0, 0, 1.5, 0, 0, 1.0, 0, 0, 8.0, 0, 0, 8.0, 0, 0, 0, 0, 0)


def loop(first, axes=AXES):
    return {axis: {"p": first + at, "i": 0.25, "d": 0.125} for at, axis in enumerate(axes)}


def tunings(axes=AXES, rate=3.0, stabilize=6.0, rudder_p=0.0, **more):
    pids = {"ratePIDs": loop(rate, axes), "stabPIDs": loop(stabilize, axes), **more}
    if "rudder" in axes:
        pids["stabPIDs"]["rudder"] = {"p": rudder_p, "i": 0.0, "d": 0.0}
    return PIDTuningsCommand(pids=pids)


def wire(values):
    return struct.pack(f">{len(values)}f", *values)


def refusal(outcome):
    assert isinstance(outcome[0], CommandRefusedError)
    return outcome[0]


@pytest.fixture
def tuned(make_rig, monkeypatch):
    # The clock stands still here: the disk answers immediately. The thread has its own tests.
    monkeypatch.setattr(DiskThread, "run", lambda _, work: maybeDeferred(work))

    def make(framing="checked", pids=GOOD, **more):
        config = {} if pids is None else {"pids.yml": pids}
        return make_rig(framing, {**config, **more.pop("config", {})}, modules=[Ground], **more)

    return make


def test_a_disarmed_board_that_differs_gets_pids_yml_once(tuned):
    rig = tuned()
    rig.connect()
    rig.alive(2)
    assert rig.sent(PUSHED) == [wire(SAVED)]
    assert rig.module(PIDTuningsProvider).current.rate.ailerons.p == 2.0


def test_a_board_that_does_not_differ_is_left_alone(tuned):
    rig = tuned()
    rig.gains[:] = struct.unpack(">18f", wire(SAVED))
    rig.connect()
    rig.alive(2)
    assert rig.sent("G") == [b""]
    assert rig.sent(PUSHED) == []


def test_the_bus_hears_what_flies_at_first_and_when_it_changes(tuned):
    rig = tuned()
    told = []
    rig.up.command_executor.register_command(PIDTuningsValuesCommand, told.append)
    rig.connect()
    rig.alive(2)
    assert [each.data["ratePIDs"]["ailerons"]["p"] for each in told] == [FACTORY[0], 2.0]
    rig.up.command_executor.execute_command(PIDTuningsCommand(request=True))
    rig.alive(1)
    assert len(told) == 2


def test_a_board_whose_eeprom_holds_none_gets_them_stored(tuned):
    rig = tuned()
    rig.gains[:] = struct.unpack(">18f", wire(SAVED))
    rig.flags &= ~64
    rig.connect()
    rig.alive(2)
    assert rig.sent(PUSHED) == [wire(SAVED)]


def test_nothing_is_pushed_to_an_armed_board(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.alive(3)
    assert rig.sent("G") == [b""]
    assert rig.sent(PUSHED) == []
    assert rig.gains == list(FACTORY)


def test_nothing_is_pushed_before_the_board_said_that_it_is_disarmed(tuned):
    rig = tuned()
    rig.start()
    rig.say("O", b"\0" * 26)
    rig.advance(0.9)
    assert rig.sent("G") != []
    assert rig.sent(PUSHED) == []
    rig.status(armed=False)
    assert rig.sent(PUSHED) == [wire(SAVED)]


def test_a_board_that_was_armed_gets_them_when_it_is_disarmed(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.alive(1)
    rig.alive(1, armed=False)
    assert rig.sent(PUSHED) == [wire(SAVED)]


def test_an_armed_board_that_was_reset_is_asked_and_gets_nothing(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.status(uptime_s=100)
    rig.forget()
    rig.status(uptime_s=0, cause=0x88)
    rig.alive(2)
    assert rig.sent("G") == [b""]
    assert rig.sent(PUSHED) == []


def test_without_pids_yml_nothing_is_pushed(tuned):
    rig = tuned(pids=None)
    rig.connect()
    rig.alive(1)
    assert rig.sent(PUSHED) == []
    assert not (rig.folder / "pids.yml").exists()


@pytest.mark.parametrize(
    "corrupt",
    [
        "units: degrees per second\nrate: {ailerons: {p: .nan}}\n",
        "rate:\n  ailerons: {p: 6}\n",
        "\x00\x01",
        GOOD.replace("p: 2.0", "p: 51"),
        GOOD[:300],
    ],
)
def test_a_corrupt_file_forbids_arming_and_is_not_pushed(tuned, corrupt):
    rig = tuned(pids=corrupt)
    assert "pids.yml" in rig.up.vetoes.own
    rig.connect()
    rig.alive(1)
    assert rig.sent(PUSHED) == []
    assert set(rig.sent("v")) == {b"\1"}


def test_a_set_from_the_ground_flies_and_is_saved_after_the_board_confirmed(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.forget()
    assert rig.ask(tunings()) == ["done"]
    assert len(rig.sent("g")) == 1
    assert rig.gains[:3] == [3.0, 0.25, 0.125]
    saved, problem = PidsFile(rig.folder).load()
    assert problem is None
    assert gain_set_to_data(saved)["ratePIDs"] == loop(3.0)
    rig.alive(1)
    rig.alive(1, armed=False)
    assert len(rig.sent(PUSHED)) == 1, "tuned gains are not overwritten"


def test_a_set_that_the_board_refuses_is_not_saved(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.refuse = {"g": 3}
    before = (rig.folder / "pids.yml").read_text()
    assert refusal(rig.ask(tunings())).detail == "out_of_range"
    assert (rig.folder / "pids.yml").read_text() == before


def test_a_set_that_the_board_does_not_hold_afterwards_is_not_saved(tuned):
    rig = tuned()
    rig.connect(armed=True)
    before = (rig.folder / "pids.yml").read_text()
    answer = rig.on_command

    def forgetful(command):
        answer(command)
        rig.gains[:] = FACTORY

    rig.on_command = forgetful
    assert refusal(rig.ask(tunings())).detail == "value_differs"
    assert (rig.folder / "pids.yml").read_text() == before


def test_the_two_axis_form_keeps_the_rudder(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.forget()
    assert rig.ask(tunings(AXES[:2])) == ["done"]
    assert len(rig.sent("g")) == 1
    assert rig.gains[6:9] == list(FACTORY[6:9])
    saved, _ = PidsFile(rig.folder).load()
    assert tuple(saved.rate.rudder) == FACTORY[6:9]
    assert saved.rate.elevator.p == 4.0


def test_the_two_axis_form_waits_until_the_rudder_of_the_board_is_known(tuned):
    rig = tuned()
    rig.mute = {"G"}
    rig.connect(armed=True)
    assert refusal(rig.ask(tunings(AXES[:2]))).detail == "unknown"
    assert rig.sent("g") == []


def test_a_set_while_another_is_on_its_way_is_refused(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.mute = {"g"}
    first = rig.ask(tunings())
    assert refusal(rig.ask(tunings(rate=9.0))).detail == "busy"
    rig.mute = set()
    rig.alive(0.8)
    assert first == ["done"]
    assert rig.gains[0] == 3.0
    assert rig.ask(tunings(rate=9.0)) == ["done"]


def test_a_set_without_an_arduino_is_refused_and_the_next_one_is_not(tuned):
    rig = tuned()
    rig.start_alone()
    assert refusal(rig.ask(tunings())).code is Code.UNAVAILABLE
    rig.status(armed=True)
    assert rig.ask(tunings()) == ["done"]


def test_a_good_set_mends_a_corrupt_file(tuned):
    rig = tuned(pids="rate: 6\n")
    rig.connect(armed=False)
    assert "pids.yml" in rig.up.vetoes.own
    assert rig.ask(tunings()) == ["done"]
    assert rig.up.vetoes.own == {}


def test_a_disk_that_refuses_is_told(tuned, monkeypatch):
    rig = tuned()
    rig.connect(armed=True)

    def full(self, gains):
        raise OSError("no space left on device")

    monkeypatch.setattr(PidsFile, "save", full)
    outcome = refusal(rig.ask(tunings()))
    assert outcome.code is Code.FAILED
    assert outcome.detail == "gains_not_saved"


def test_a_request_is_answered_with_what_the_board_holds_in_full_precision(tuned):
    rig = tuned()
    rig.connect(armed=True)
    rig.gains[1] = 0.0012345678
    assert rig.ask(PIDTuningsCommand(request=True)) == ["done"]
    (message,) = rig.module(Ground).sent
    assert message.name == "arduino.pids.values"
    gain = message.data["ratePIDs"]["ailerons"]["i"]
    assert struct.pack(">f", gain) == struct.pack(">f", 0.0012345678)
    assert set(message.data) == {"ratePIDs", "stabPIDs"}


@pytest.mark.parametrize("changes", [{"rudder_p": 0.5}, {"navPIDs": loop(0.5)}])
def test_a_gain_that_nothing_uses_is_kept_and_not_changed(tuned, changes):
    rig = tuned()
    rig.connect(armed=True)
    assert refusal(rig.ask(tunings(**changes))).code is Code.NOT_SUPPORTED
    assert rig.sent(PUSHED) == []
    zero = {axis: {"p": 0.0, "i": 0.0, "d": 0.0} for axis in AXES}
    assert rig.ask(tunings(navPIDs=zero)) == ["done"], "as a client of the thesis sends them"
    rig.ask(PIDTuningsCommand(request=True))
    assert set(rig.module(Ground).sent[-1].data) == {"ratePIDs", "stabPIDs"}


def test_a_request_without_a_ground_or_an_arduino_is_refused(tuned):
    rig = tuned()
    rig.start_alone()
    assert refusal(rig.ask(PIDTuningsCommand(request=True))).code is Code.UNAVAILABLE
    rig.status(armed=True)
    rig.module(Ground).is_there = False
    assert refusal(rig.ask(PIDTuningsCommand(request=True))).code is Code.UNAVAILABLE


def test_gains_that_a_board_cannot_have_are_not_believed(tuned):
    rig = tuned()
    rig.gains[4] = float("nan")
    rig.connect(armed=False)
    rig.alive(1)
    assert rig.module(PIDTuningsProvider).current is None
    assert refusal(rig.ask(PIDTuningsCommand(request=True))).detail == "invalid_value"


def test_an_old_firmware_gets_them_when_it_is_met_and_the_throttle_is_low(tuned):
    rig = tuned("thesis")
    rig.start()
    rig.throttle(1000)
    rig.advance(0.5)
    assert rig.sent("t") == [wire((*SAVED[0:6], *SAVED[9:15]))]
    rig.port.unplug()
    rig.turn()
    rig.forget()
    rig.gains[:] = FACTORY
    rig.port.plug_in()
    rig.advance(2)
    rig.throttle(1000)
    rig.advance(0.5)
    assert rig.sent("T") != []
    assert rig.sent("t") == [], "one that comes back may be flying"


def test_an_old_firmware_under_throttle_gets_nothing(tuned):
    rig = tuned("thesis")
    rig.start()
    rig.throttle(1400)
    rig.advance(0.5)
    assert rig.sent("T") == [b""]
    assert rig.sent("t") == []


def test_an_old_firmware_takes_two_axes_only(tuned):
    rig = tuned("thesis")
    rig.start()
    rig.throttle(1400)
    assert refusal(rig.ask(tunings())).detail == "old_firmware"
    assert rig.sent("t") == []
    assert rig.ask(tunings(AXES[:2])) == ["done"]
    assert rig.gains[:3] == [3.0, 0.25, 0.125]
    saved, _ = PidsFile(rig.folder).load()
    assert saved.rate.ailerons.p == 3.0
    assert saved.rate.rudder.p == 1.0, "the saved rudder stays"


def test_where_the_raspberry_controls_this_module_does_not(tuned):
    rig = tuned(config={"config.yml": "flight controller: raspberry\n"})
    rig.connect()
    rig.alive(1)
    assert rig.module(PIDTuningsProvider) is None
    assert rig.sent("GTgt") == []
