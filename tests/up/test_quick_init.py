import copy
import inspect
import pickle
from dataclasses import FrozenInstanceError, dataclass, field, replace

import pytest

from up.flight_modes.flight_mode import FlightSituation
from up.flight_modes.navigation_state import NavigationState
from up.quick_init import quick_init


@dataclass(frozen=True, slots=True)
class Usual:
    name: str
    altitude_m: float
    valid: bool = True


@quick_init
@dataclass(frozen=True, slots=True)
class Quick:
    name: str
    altitude_m: float
    valid: bool = True


class Plain(Quick):
    """A subclass with a dictionary."""


@quick_init
@dataclass(frozen=True, slots=True)
class Longer(Quick):
    source: str = "a"


def test_it_takes_the_same_arguments():
    assert inspect.signature(Quick) == inspect.signature(Usual)
    quick = Quick("a", altitude_m=3.5)
    assert (quick.name, quick.altitude_m, quick.valid) == ("a", 3.5, True)
    for arguments in ((), ("a",), ("a", 1.0, True, 4)):
        with pytest.raises(TypeError):
            Quick(*arguments)


@pytest.mark.parametrize("kind", [Quick, Plain, Longer])
def test_it_stays_frozen_and_of_its_class(kind):
    quick = kind("a", 1.0)
    assert type(quick) is kind
    with pytest.raises(FrozenInstanceError):
        quick.altitude_m = 2.0
    with pytest.raises(FrozenInstanceError):
        del quick.name
    assert quick.altitude_m == 1.0


def test_it_is_compared_copied_and_pickled():
    quick = Quick("a", 1.0)
    assert quick == Quick("a", 1.0) != Quick("a", 2.0)
    assert hash(quick) == hash(Quick("a", 1.0))
    assert replace(quick, altitude_m=2.0) == Quick("a", 2.0)
    assert copy.deepcopy(quick) == quick == pickle.loads(pickle.dumps(quick))


def test_a_subclass_has_its_own_fields():
    longer = Longer("a", 1.0, source="b")
    assert (longer.name, longer.altitude_m, longer.valid, longer.source) == ("a", 1.0, True, "b")


@pytest.mark.parametrize("kind", [FlightSituation, NavigationState])
def test_what_each_frame_needs_has_it(kind):
    assert kind.__init__.__wrapped__.__qualname__ == f"{kind.__qualname__}.__init__"


def test_a_class_that_needs_the_usual_constructor_is_an_error():
    @dataclass(frozen=True, slots=True)
    class Counted:
        counts: dict[str, int] = field(default_factory=dict)

    @dataclass(frozen=True, slots=True)
    class Checked:
        count: int

        def __post_init__(self):
            raise ValueError

    for kind in (Counted, Checked):
        with pytest.raises(TypeError):
            quick_init(kind)
