"""Orders modules by what they need, and fills their references in."""

from __future__ import annotations

from collections.abc import Container, Sequence

from up.base_module import BaseModule
from up.loading.plan import BootError
from up.needs import declared_needs


def order(modules: Sequence[BaseModule]) -> list[BaseModule]:
    """Return the modules so that each comes after what it needs; ``LOAD_ORDER`` breaks ties.

    References are filled in. Raises BootError with one sentence for each missing need, or for a
    circular one.
    """
    missing: list[str] = []
    uses = {id(module): _fill(module, modules, missing) for module in modules}
    if missing:
        raise BootError("\n".join(missing))
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
            raise BootError(_circle(left, uses))
        placed.add(id(ready))
        ordered.append(ready)
    return ordered


def needed_by(module: BaseModule) -> list[BaseModule]:
    """Return the modules that a filled-in module cannot do without."""
    return [
        getattr(module, need.attribute)
        for need in declared_needs(type(module))
        if not need.optional
    ]


def forget_wanted(module: BaseModule, failed: Container[BaseModule]) -> None:
    """Let a module do without what it only wanted and what has failed."""
    references = vars(module).get("_references", {})
    for need in declared_needs(type(module)):
        if need.optional and references.get(need.attribute) in failed:
            references[need.attribute] = None


def _fill(
    module: BaseModule, modules: Sequence[BaseModule], missing: list[str]
) -> list[BaseModule]:
    references: dict[str, BaseModule | None] = {}
    used: list[BaseModule] = []
    for need in declared_needs(type(module)):
        matching = [each for each in modules if isinstance(each, need.wanted)]
        if not matching and not need.optional:
            missing.append(
                f"{module.path} needs {need.wanted.__name__}, which is not loaded: register the"
                " cog that brings it, or list the module in disabled_modules.yml"
            )
        references[need.attribute] = matching[0] if matching else None
        used.extend(matching[:1])
    vars(module)["_references"] = references
    return [each for each in used if each is not module]


def _circle(left: list[BaseModule], uses: dict[int, list[BaseModule]]) -> str:
    waiting = {id(module) for module in left}
    path = [left[0]]
    while True:
        following = next(used for used in uses[id(path[-1])] if id(used) in waiting)
        if following in path:
            circle = [*path[path.index(following) :], following]
            return "modules need each other in a circle: " + " -> ".join(
                module.class_name for module in circle
            )
        path.append(following)
