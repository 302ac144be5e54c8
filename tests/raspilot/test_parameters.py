"""Keys of configuration files that a ground sets: what is written, refused, and vetoed."""

import pytest
from twisted.internet.defer import Deferred

from raspilot.flight_modes.loiter import LOITER
from raspilot.modules.failsafes import Failsafes
from raspilot.modules.parameters import VETO, Parameters
from tests.raspilot.navigation_rig import NavigationRig
from up.base_module import BaseModule
from up.commands.parameter_commands import ParameterRequestCommand, ParameterSetCommand
from up.config.application import APPLICATION

FILE = "# My circle.\nradius_m: 60  # wide\n"
FENCE = "fence: {radius_m: 500, floor_m: 20}\n"


class LateDisk:
    """Does each piece of work when the test says so."""

    def __init__(self):
        self.waiting = []

    def run(self, work):
        done = Deferred()
        self.waiting.append(lambda: done.callback(work()))
        return done


class Reader(BaseModule):
    """Reads a file whose keys are not a ground's."""

    CONFIG = APPLICATION


class ParameterRig(NavigationRig):
    def __init__(self, folder, loiter=FILE, failsafe=FENCE, *, is_reported=True):
        super().__init__(
            folder, modules=(Failsafes, Parameters, Reader), loiter=loiter, failsafe=failsafe
        )
        self.folder = folder
        self.parameters = self.up.get_module(Parameters)
        if is_reported:
            self.state("FBW", armed=False, auto=False, in_flight=False)

    def set(self, file, key, value):
        """Return the code of the refusal, None after success."""
        got = self.outcome(ParameterSetCommand(file, key, value))
        self.parameters._disk.wait()
        self.clock.advance(0.0)
        return None if got == [None] else (got[0].value.code.value, got[0].value.detail)

    def text(self, file):
        return (self.folder / file).read_text()

    def shown(self, file):
        self.ground.sent.clear()
        self.outcome(ParameterRequestCommand())
        return next(each for each in self.ground.sent if each.file == file)

    @property
    def is_vetoed(self):
        return VETO in self.up.vetoes.own


@pytest.fixture
def rig(tmp_path):
    return ParameterRig(tmp_path)


def test_a_key_is_written_acts_at_the_next_start_and_until_then_nothing_arms(rig):
    assert rig.set("loiter.yml", "radius_m", "75.5") is None
    assert rig.text("loiter.yml") == "# My circle.\nradius_m: 75.5  # wide\n"
    assert rig.is_vetoed
    shown = rig.shown("loiter.yml")
    assert (shown.values["radius_m"], shown.next_start) == (60.0, {"radius_m": 75.5})
    assert rig.up.context.config(LOITER).radius_m == 60.0
    again = ParameterRig(rig.folder, rig.text("loiter.yml"))
    assert again.up.context.config(LOITER).radius_m == 75.5 and not again.is_vetoed
    assert rig.set("loiter.yml", "radius_m", "60") is None
    assert not rig.is_vetoed and rig.shown("loiter.yml").next_start == {}


def test_nothing_arms_until_the_last_of_several_writes_is_done(rig):
    # The two leave no key pending: nothing but the writing itself forbids arming.
    commands = [ParameterSetCommand("loiter.yml", "radius_m", "60") for _ in range(2)]
    vetoed = []
    rig.parameters._disk = LateDisk()
    for command in commands:
        rig.outcome(command)
    for done in rig.parameters._disk.waiting:
        vetoed.append(rig.is_vetoed)
        done()
    assert (vetoed, rig.is_vetoed) == ([True, True], False)


def test_a_key_that_is_not_in_the_file_is_added_with_its_section(rig):
    for key, value in (("uplink_lost.action", "warn"), ("fence.ceiling_m", "90"),
                       ("uplink_lost.delay_s", "12"), ("fence.radius_m", "null")):  # fmt: skip
        assert rig.set("failsafe.yml", key, value) is None
    assert rig.text("failsafe.yml") == (
        "fence: {ceiling_m: 90, radius_m: null, floor_m: 20}\n"
        "uplink_lost:\n  delay_s: 12\n  action: warn\n"
    )
    assert rig.set("guided.yml", "radius_m", "80") is None
    assert rig.text("guided.yml") == "radius_m: 80\n"


@pytest.mark.parametrize(
    ("file", "key", "value", "refusal"),
    [
        ("loiter.yml", "radius", "60", ("invalid", "parameter_unknown")),
        ("loiter.yml", "radius_m", "4", ("invalid", "out_of_range")),
        ("loiter.yml", "radius_m", "wide", ("invalid", "wrong_type")),
        ("loiter.yml", "radius_m", "60\nmore: 1", ("invalid", "bad_format")),
        ("failsafe.yml", "fence.ceiling_m", "20", ("invalid", "inconsistent")),
        ("failsafe.yml", "others", "x", ("invalid", "parameter_unknown")),
        ("mission_control.yml", "role", "pilot", ("invalid", "parameter_unknown")),
        ("../loiter.yml", "radius_m", "60", ("invalid", "parameter_unknown")),
        ("config.yml", "flight controller", "raspberry", ("invalid", "parameter_unknown")),
    ],
)
def test_what_is_refused_changes_no_file(rig, file, key, value, refusal):
    before = {path.name: path.read_bytes() for path in rig.folder.iterdir()}
    assert rig.set(file, key, value) == refusal
    assert {path.name: path.read_bytes() for path in rig.folder.iterdir()} == before
    assert not rig.is_vetoed


@pytest.mark.parametrize("flight", [{"armed": True}, {"in_flight": True}, {"in_flight": None}])
def test_nothing_is_written_while_the_aircraft_is_armed_or_may_fly(rig, flight):
    rig.state("FBW", **{"armed": False, "auto": False, "in_flight": False, **flight})
    assert rig.set("loiter.yml", "radius_m", "75") == ("refused", "in_flight")
    assert rig.text("loiter.yml") == FILE


def test_nothing_is_written_before_the_board_has_reported(tmp_path):
    rig = ParameterRig(tmp_path, is_reported=False)
    assert rig.set("loiter.yml", "radius_m", "75") == ("refused", "in_flight")
    assert rig.text("loiter.yml") == FILE


def test_a_file_in_another_form_or_with_mistakes_stays(tmp_path):
    form = 'uplink_lost:\n  action: "RE\\\n    TURN"\n'
    rig = ParameterRig(tmp_path, "radius_m:\n  60\n", form)
    assert rig.set("loiter.yml", "radius_m", "75") is None
    assert rig.text("loiter.yml") == "radius_m:\n  75\n"
    assert rig.set("failsafe.yml", "uplink_lost.action", "warn") == (
        "not_supported", "parameter_not_saved",
    )  # fmt: skip
    (tmp_path / "loiter.yml").write_text("radius_m: 60\nwidth_m: 4\n")
    assert rig.set("loiter.yml", "radius_m", "75") == ("invalid", "unknown_key")
    assert rig.text("failsafe.yml") == form
