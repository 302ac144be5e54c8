import copy
import dataclasses
import inspect
import pickle
from dataclasses import FrozenInstanceError, field, fields, replace
from typing import ClassVar

import pytest

from up.quick_dataclass import dataclass

BOTH = [dataclasses.dataclass, dataclass]


def family(decorate):
    """Return the same classes, made by one decorator."""

    @decorate(frozen=True, slots=True)
    class Base:
        """A base."""

        KIND: ClassVar[str] = "base"
        name: str
        altitude_m: float = 1.0
        tags: list[str] = field(default_factory=list, compare=False)
        secret: str = field(default="s", repr=False)

    @decorate(frozen=True, slots=True)
    class Longer(Base):
        altitude_m: float = 2.0
        count: int = field(init=False, default=3)
        more: dict[str, int] = field(init=False, default_factory=dict)

        def __post_init__(self):
            if self.altitude_m < 0:
                raise ValueError("below the ground")

    @decorate(slots=True)
    class Counter:
        count: int = 0

    @decorate(frozen=True, slots=True, eq=False)
    class Identity:
        value: float

    @decorate(kw_only=True)
    class Named:
        value: float
        other: float = 1.0

        def __repr__(self):
            return "own"

    @decorate(frozen=True)
    class Empty:
        pass

    class Plain(Base):
        """A subclass with a dictionary."""

    return Base, Longer, Counter, Identity, Named, Empty, Plain


PAIRS = list(zip(family(dataclasses.dataclass), family(dataclass), strict=True))
CALLS = [
    ((), {}), (("a",), {}), (("a", -1.0), {}), (("a", 2.0, ["x"], "t"), {}), ((), {"value": 1.0}),
    ((1.0, 2.0, 3.0, 4.0, 5.0), {}), ((), {"count": 4}), ((), {"name": "b"}),
    ((), {"unknown": 1}), (("a",), {"secret": 1}),
]  # fmt: skip


def outcome(action, *arguments, **named):
    try:
        return repr(action(*arguments, **named))
    except (TypeError, ValueError, AttributeError, FrozenInstanceError) as error:
        return type(error)


def set_and_delete(instance, name):
    done = outcome(setattr, instance, name, 7), outcome(delattr, instance, name)
    # With slots the usual one fails in its guard for a name that is no field.
    return [FrozenInstanceError if each is TypeError else each for each in done]


@pytest.mark.parametrize(("usual", "quick"), PAIRS, ids=lambda each: each.__name__)
def test_it_behaves_as_the_usual_one(usual, quick):
    # The default of a factory is an object of each.
    assert str(inspect.signature(quick)) == str(inspect.signature(usual))
    assert [(f.name, f.type, f.default) for f in fields(quick)] == [
        (f.name, f.type, f.default) for f in fields(usual)
    ]
    assert quick.__match_args__ == usual.__match_args__
    assert quick.__dataclass_params__.frozen == usual.__dataclass_params__.frozen
    for arguments, named in CALLS:
        made = [outcome(kind, *arguments, **named) for kind in (usual, quick)]
        assert made[0] == made[1], (arguments, named)
        if not isinstance(made[0], type):
            usual_ways = ways(usual(*arguments, **named), usual(*arguments, **named))
            assert ways(quick(*arguments, **named), quick(*arguments, **named)) == usual_ways


def ways(instance, other):
    """Return how an instance is compared, hashed and changed."""
    names = [each.name for each in fields(instance)]
    changed = [*names, "new"] if not hasattr(instance, "__dict__") else names
    return (
        instance == other,
        other == instance,
        instance == "another",
        outcome(lambda: hash(instance) == hash(other)),
        [set_and_delete(instance, name) for name in changed],
    )


@dataclass(frozen=True, slots=True)
class Kept:
    name: str
    altitude_m: float = 1.0


def test_it_is_replaced_copied_and_pickled():
    kept = Kept("a")
    assert replace(kept, altitude_m=2.0) == Kept("a", 2.0) != kept
    assert copy.deepcopy(kept) == kept == pickle.loads(pickle.dumps(kept)) == copy.copy(kept)
    assert dataclasses.asdict(kept) == {"name": "a", "altitude_m": 1.0}


@pytest.mark.parametrize("base", BOTH)
@pytest.mark.parametrize("child", BOTH)
def test_the_two_inherit_from_each_other(base, child):
    @base(frozen=True, slots=True)
    class A:
        a: int

    @child(frozen=True, slots=True)
    class B(A):
        b: int = 2

    made = B(1)
    assert (made.a, made.b) == (1, 2)
    for name in ("a", "b"):
        with pytest.raises(FrozenInstanceError):
            setattr(made, name, 3)
    with pytest.raises(TypeError):

        @child(slots=True)
        class C(A):
            c: int = 3


def test_the_constructor_is_compiled_at_its_first_use():
    @dataclass(frozen=True, slots=True)
    class Late:
        a: int

    assert not inspect.isfunction(vars(Late)["__init__"])
    assert Late(1).a == 1
    assert inspect.isfunction(vars(Late)["__init__"])
