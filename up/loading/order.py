"""Orders modules by their needs, and fills in their references."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from up.base_module import BaseModule
from up.loading.plan import BootError, path_of
from up.needs import declared_needs


def order(
    modules: Sequence[BaseModule], left_out: Mapping[type[BaseModule], str] = MappingProxyType({})
) -> list[BaseModule]:
    """Return the modules so that each comes after those that it needs; ``LOAD_ORDER`` breaks ties.

    Fills in the references. Raises BootError with one sentence for each missing or circular need;
    ``left_out`` gives the reason why a discovered class is not among the modules.
    """
    absent: list[tuple[BaseModule, type[BaseModule]]] = []
    uses = {id(module): _fill(module, modules, absent) for module in modules}
    missing = [_missing(module, wanted, left_out) for module, wanted in absent]
    if missing:
        raise BootError.group(missing)
    ranked = sorted(modules, key=lambda module: module.LOAD_ORDER)
    ordered: list[BaseModule] = []
    placed: set[int] = set()
    while len(ordered) < len(ranked):
        ready = next(
            (
                module
                for module in ranked
                if id(module) not in placed and all(id(used) in placed for used in uses[id(module)])
            ),
            None,
        )
        if ready is None:
            left = [module for module in ranked if id(module) not in placed]
            raise _circle(left, uses)
        placed.add(id(ready))
        ordered.append(ready)
    return ordered


def _fill(
    module: BaseModule,
    modules: Sequence[BaseModule],
    absent: list[tuple[BaseModule, type[BaseModule]]],
) -> list[BaseModule]:
    used: list[BaseModule] = []
    for need in declared_needs(type(module)):
        matching = [each for each in modules if isinstance(each, need.wanted)]
        if not matching and not need.optional:
            absent.append((module, need.wanted))
        vars(module)[need.attribute] = matching[0] if matching else None
        used.extend(matching[:1])
    return [each for each in used if each is not module]


def _missing(
    module: BaseModule, wanted: type[BaseModule], left_out: Mapping[type[BaseModule], str]
) -> BootError:
    reasons = [
        f"{path_of(cls)}: {reason}" for cls, reason in left_out.items() if issubclass(cls, wanted)
    ]
    known = f" ({'; '.join(reasons)})" if reasons else ""
    way = "fix that" if reasons else "register the cog that brings it"
    return BootError(
        f"{module.path} needs {wanted.__name__}, which is not loaded{known}: {way}, or list"
        f" {module.path} in disabled_modules.yml",
        "need_missing",
        module=module.path,
        needs=path_of(wanted),
        reasons=reasons,
    )


def _circle(left: list[BaseModule], uses: dict[int, list[BaseModule]]) -> BootError:
    waiting = {id(module) for module in left}
    path = [left[0]]
    while True:
        following = next(used for used in uses[id(path[-1])] if id(used) in waiting)
        if following in path:
            circle = [*path[path.index(following) :], following]
            names = [module.class_name for module in circle]
            text = f"modules need each other in a circle: {' -> '.join(names)}"
            return BootError(text, "need_circle", modules=names)
        path.append(following)
