"""Selects among the discovered classes: mode, ``load()``, disabled list, overrides."""

import inspect
from collections.abc import Iterable, Sequence
from pathlib import Path

from up.base_module import BaseModule
from up.builtin_modules import BUILTIN_MODULES
from up.context import Context
from up.loading.discovery import IMPORT_FAULTS, Discovered
from up.loading.plan import BootError, Plan, Rejected, path_of, problem_of
from up.needs import declared_needs


def select(
    found: Discovered,
    builtins: Sequence[type[BaseModule]],
    context: Context,
    disabled: Iterable[str],
) -> Plan:
    """Return the plan with the selected modules, not yet ordered.

    Raises BootError when two unrelated modules replace one provider, one sentence for each.
    """
    plan = Plan(problems=list(found.problems))
    refused = set(disabled)
    chosen: list[BaseModule] = []
    for cls in (*builtins, *found.modules):
        plan.origins[path_of(cls)] = found.origins.get(cls, "built in")
        if path_of(cls) in refused or cls.__module__ in refused:
            _reject(plan, cls, "listed in disabled_modules.yml", "disabled")
            continue
        if context.mode not in cls.MODES:
            _reject(plan, cls, f"not for the mode {context.mode.value!r}", "other_mode")
            continue
        if not _is_for(cls, context.application.flight_controller):
            _reject(plan, cls, "not for this 'flight controller' (config.yml)", "other_board")
            continue
        module = _build(cls, context, plan)
        if module is not None:
            chosen.append(module)
    plan.modules = _without_overridden(chosen, builtins, plan)
    return plan


def _is_for(cls: type[BaseModule], controller: str) -> bool:
    """Return whether a module, and each that it requires, is for this flight controller."""
    wanted, seen = [cls], set[type[BaseModule]]()
    while wanted:
        each = wanted.pop()
        if each.FLIGHT_CONTROLLERS is not None and controller not in each.FLIGHT_CONTROLLERS:
            return False
        if each not in seen:
            seen.add(each)
            wanted += [need.wanted for need in declared_needs(each) if not need.optional]
    return True


def _build(cls: type[BaseModule], context: Context, plan: Plan) -> BaseModule | None:
    from up.config import ConfigErrors

    try:
        module = cls()
        module.bind(context)
        wanted = module.load()
    except ConfigErrors:
        raise
    except IMPORT_FAULTS as error:
        problem = problem_of(path_of(cls), Path(inspect.getfile(cls)), error, "build_failed")
        plan.problems.append(problem)
        plan.left_out[cls] = problem.what
        return None
    if not wanted:
        _reject(plan, cls, "its load() returned False", "load_false")
        return None
    return module


def _reject(plan: Plan, cls: type[BaseModule], reason: str, code: str) -> None:
    plan.rejected.append(Rejected(path_of(cls), reason, code))
    plan.left_out[cls] = reason


def _without_overridden(
    modules: list[BaseModule], builtins: Sequence[type[BaseModule]], plan: Plan
) -> list[BaseModule]:
    kept: list[BaseModule] = []
    replaced: list[type[BaseModule]] = []
    for module in modules:
        kind = type(module)
        over = [each for each in modules if type(each) is not kind and isinstance(each, kind)]
        if over:
            _reject(plan, kind, f"replaced by {over[-1].path}", "replaced")
            replaced.append(kind)
        else:
            kept.append(module)
    conflicts = _conflicts(kept, dict.fromkeys((*builtins, *replaced)))
    if conflicts:
        raise BootError.group(conflicts)
    return kept


def _conflicts(kept: list[BaseModule], bases: Iterable[type[BaseModule]]) -> list[BootError]:
    """Return an error for each set of modules that replace the same one."""
    found: dict[tuple[str, ...], type[BaseModule]] = {}
    for base in bases:
        heirs = tuple(each.path for each in kept if isinstance(each, base))
        if len(heirs) > 1 and issubclass(base, found.get(heirs, base)):
            found[heirs] = base
    return [
        BootError(
            f"{' and '.join(heirs)} both replace {base.__name__}: list one of them in"
            f" disabled_modules.yml{_way_out(base)}",
            "replacement_conflict",
            modules=heirs,
            base=base.__name__,
        )
        for heirs, base in found.items()
    ]


def _way_out(base: type[BaseModule]) -> str:
    if base in BUILTIN_MODULES:
        return ""
    return (
        f" (if {base.__name__} is only what they have in common, begin its name with an"
        " underscore, then it is not a module)"
    )
