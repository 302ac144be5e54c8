import pytest
from twisted.internet.defer import CancelledError, Deferred
from twisted.internet.task import Clock

from tests.support.system import build_up
from tests.up.commands.samples import Log, NumberCommand
from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule, StartFailedError, StartResult
from up.commands.base_command_handler import BaseCommandHandler
from up.life_cycle import BootStoppedError, LifeCycle
from up.needs import needs, wants

calls = []


@pytest.fixture(autouse=True)
def forget():
    calls.clear()


class Noted(BaseStartedModule):
    """Records the calls of its life cycle."""

    def on_start(self):
        calls.append(f"{self.class_name} starts")

    def on_stop(self):
        calls.append(f"{self.class_name} stops")


class First(Noted):
    """Needs nothing."""


class Second(Noted):
    """Comes after First."""

    first = needs(First)


class Third(Noted):
    """Comes after Second."""

    second = needs(Second)


class System:
    """A small system whose time the test controls."""

    def __init__(self, folder, *classes):
        self.clock = Clock()
        self.up = build_up(classes, self.clock, folder, builtins=False)
        self.life = LifeCycle(self.up)

    def start(self):
        return self._begin(self.life.start())

    def stop(self):
        return self._begin(self.life.stop())

    def _begin(self, work):
        got = []
        Deferred.fromCoroutine(work).addBoth(got.append)
        return got

    @property
    def running(self):
        return [module.class_name for module in self.life.started]

    def reason(self, cls):
        return self.up.vetoes.own[f"{cls.__module__}.{cls.__qualname__}"]


def test_start_in_order_and_stop_in_reverse(tmp_path):
    system = System(tmp_path, Third, First, Second)
    assert system.start() == [None]
    assert system.running == ["First", "Second", "Third"]
    assert system.stop() == [None]
    assert calls == [
        "First starts", "Second starts", "Third starts",
        "Third stops", "Second stops", "First stops",
    ]  # fmt: skip
    assert system.stop() == [None]
    assert len(calls) == 6


def failing(name, outcome, **more):
    """Return a module class whose start returns, or raises, the outcome."""

    def start(self):
        if isinstance(outcome, BaseException):
            raise outcome
        return outcome

    return type(name, (Noted,), {"on_start": start, **more})


async def raising_later():
    raise RuntimeError("later")


FAILURES = [
    (False, "failure"),
    (StartResult.FAILED_GO_ON, "failure"),
    (RuntimeError("boom"), "RuntimeError: boom"),
    (StartFailedError("the port is taken"), "the port is taken"),
    (SystemExit("bye"), "SystemExit: bye"),
    ("rubbish", "returned 'rubbish'"),
    (7, "returned 7"),
]


@pytest.mark.parametrize(("outcome", "reason"), FAILURES)
def test_a_failed_start_is_a_veto_by_name_and_the_boot_goes_on(tmp_path, outcome, reason):
    cls = failing("Failing", outcome)
    system = System(tmp_path, cls, First)
    assert system.start() == [None]
    assert system.running == ["First"]
    assert reason in system.reason(cls)
    assert any("Failing" in each and reason in each for each in system.up.vetoes.all)
    system.stop()
    assert sorted(calls) == ["Failing stops", "First starts", "First stops"]


@pytest.mark.parametrize(
    ("outcome", "required"),
    [
        (StartResult.FAILED_STOP, False),
        (False, True),
        (RuntimeError("boom"), True),
        (SystemExit(), True),
        (StartFailedError("the port is taken"), True),
    ],
)
def test_a_required_module_that_fails_stops_the_boot(tmp_path, outcome, required):
    cls = failing("Failing", outcome, REQUIRED=required, LOAD_ORDER=1)
    system = System(tmp_path, cls, First)
    (got,) = system.start()
    assert got.check(BootStoppedError)
    assert got.value.code == "required_module_failed"
    system.stop()
    assert calls == ["First starts", "Failing stops", "First stops"]


def test_results_that_mean_started(tmp_path):
    async def start():
        return True

    for number, outcome in enumerate((None, True, StartResult.STARTED, start())):
        system = System(tmp_path / str(number), failing("Fine", outcome))
        system.start()
        assert system.running == ["Fine"]


def test_a_start_that_fails_later(tmp_path):
    cls = failing("Failing", raising_later())
    system = System(tmp_path, cls)
    system.start()
    assert "RuntimeError: later" in system.reason(cls)


def test_what_needs_a_failed_module_is_not_started_however_far(tmp_path):
    class Broken(First):
        def on_start(self):
            raise RuntimeError("boom")

    class Fourth(BaseModule):
        third = needs(Third)

    class Lone(Noted):
        broken = wants(First)

    system = System(tmp_path, Broken, Second, Third, Fourth, Lone)
    system.start()
    assert system.running == ["Lone"]
    assert "needs Broken" in system.reason(Second)
    assert "needs Second" in system.reason(Third)
    assert len(system.up.vetoes.own) == 4


class Hanging(Noted):
    """Never reports that it started."""

    def on_start(self):
        return Deferred()


class Stubborn(Noted):
    """Ignores every request to stop."""

    async def on_start(self):
        while True:
            try:
                await Deferred()
            except CancelledError:
                calls.append("told")


@pytest.mark.parametrize("cls", [Hanging, Stubborn])
def test_a_start_that_hangs_is_given_up(tmp_path, cls):
    system = System(tmp_path, cls, First)
    done = system.start()
    system.clock.advance(9.9)
    assert not done
    system.clock.advance(0.2)
    assert done == [None]
    assert system.running == ["First"]
    assert "10 s" in system.reason(cls)
    assert not system.clock.getDelayedCalls()


@pytest.mark.parametrize("cls", [Hanging, Stubborn])
def test_a_stop_during_the_start_starts_nothing_more(tmp_path, cls):
    class Last(Noted):
        LOAD_ORDER = 2

    hanging = type(cls.__name__, (cls,), {"LOAD_ORDER": 1})
    system = System(tmp_path, First, hanging, Last)
    starting = system.start()
    assert calls == ["First starts"]
    assert system.stop() == [None]
    assert starting == [None]
    system.clock.advance(60)
    assert [call for call in calls if call != "told"] == [
        "First starts", f"{cls.__name__} stops", "First stops",
    ]  # fmt: skip
    assert not system.up.vetoes.own
    assert not system.clock.getDelayedCalls()


class BadStop(Noted):
    """Raises when it is stopped."""

    LOAD_ORDER = 1

    def on_stop(self):
        raise RuntimeError("bad stop")


class ExitingStop(Noted):
    """Calls sys.exit when it is stopped."""

    LOAD_ORDER = 2

    def on_stop(self):
        raise SystemExit


class HangingStop(Noted):
    """Never stops."""

    LOAD_ORDER = 3

    async def on_stop(self):
        while True:
            try:
                await Deferred()
            except CancelledError:
                calls.append("told")


def test_bad_stops_do_not_keep_the_others_running(tmp_path):
    system = System(tmp_path, First, BadStop, ExitingStop, HangingStop)
    system.start()
    with Log() as log:
        done = system.stop()
        system.clock.advance(1.4)
        assert not done
        system.clock.advance(0.2)
    assert done == [None]
    assert "First stops" in calls
    assert [event["name"] for event in log.of("stop_timeout")] == ["HangingStop"]
    assert {event["name"] for event in log.of("stop_failed")} == {"BadStop", "ExitingStop"}


def test_health_is_that_of_every_started_module(tmp_path):
    healthy = [True]

    class Doctor(Noted):
        @property
        def is_healthy(self):
            if healthy[0] is None:
                raise RuntimeError("cannot say")
            return healthy[0]

    system = System(tmp_path, Doctor, First)
    assert system.life.is_healthy
    system.start()
    for healthy[0], expected in ((True, True), (False, False), (None, False), (True, True)):
        assert system.life.is_healthy is expected


class Source(Noted):
    """Where readings could come from."""

    DATA_SOURCE = True
    is_source_open = False


def test_without_any_open_source_there_is_nothing_to_run(tmp_path):
    other = type("OtherSource", (Noted,), {"DATA_SOURCE": True, "is_source_open": False})
    system = System(tmp_path, Source, other)
    (got,) = system.start()
    assert got.check(BootStoppedError)
    assert got.value.code == "no_source"


def test_one_open_source_is_enough(tmp_path):
    other = type("OtherSource", (Source,), {"is_source_open": True})
    system = System(tmp_path, Source, other)
    assert system.start() == [None]


class TestInitialization:
    """The phase before: no module keeps the rest from flying."""

    @pytest.mark.parametrize("fault", [RuntimeError("boom"), SystemExit(1)])
    def test_a_module_that_raises_is_out_with_what_needs_it(self, tmp_path, fault):
        class Broken(First):
            def on_init(self):
                self.up.command_executor.register_command(NumberCommand, self.on_number)
                raise fault

            def on_number(self, command):
                calls.append("half a module was called")

        class Wanting(Noted):
            first = wants(First)

        system = System(tmp_path, Broken, Second, Wanting)
        system.start()
        assert system.running == ["Wanting"]
        assert "needs Broken, which failed" in system.reason(Second)
        assert system.up.get_module(Wanting).first is None
        system.up.command_executor.execute_command(NumberCommand(1))
        assert calls == ["Wanting starts"]

    def test_one_that_is_async_is_named_and_not_left_undone(self, tmp_path):
        class Later(First):
            async def on_init(self):
                calls.append("never")

        class Waiting(Noted):
            def on_init(self):
                return Deferred()

        system = System(tmp_path, Later, Waiting, Second)
        system.start()
        assert system.running == []
        assert all("TypeError" in system.reason(cls) for cls in (Later, Waiting))
        assert calls == []

    def test_a_handler_that_cannot_be_registered_is_a_veto(self, tmp_path):
        class Bad(BaseCommandHandler):
            COMMAND = BaseModule

            def run_action(self, command):
                calls.append(command)

        class Good(Bad):
            COMMAND = NumberCommand

        up = build_up((First,), Clock(), tmp_path, builtins=False)
        up._handlers = [Bad(), Good()]
        up.initialize()
        assert "Bad" in up.vetoes.own
        up.command_executor.execute_command(NumberCommand(1))
        assert calls == [NumberCommand(1)]
