"""Finds the Registrant of a cog and runs it."""

import contextlib
import importlib
import importlib.util
import inspect
from typing import Any

from up.cogs.cog import CogError
from up.cogs.registry import Registry, Source
from up.cogs.up_registrant import UpRegistrant, echo_registered
from up.cogs.up_registrar import UpRegistrar
from up.errors import UserError
from up.loading.application import Application
from up.loading.plan import reason_of
from up.output import echo

REGISTRANT_MODULE = "registrar"
REGISTRANT_CLASSES = ("Registrant", "Registrar")


def register(cog: str, application: Application, source: Source) -> None:
    """Register an installed cog with an application.

    Raises CogError with one sentence or ConfigErrors with the place of every error.
    """
    found = find_registrant(cog)
    try:
        if issubclass(found, UpRegistrant):
            registrant = found()
            _check_importable(registrant, application)
            registrant.register(application, source)
        else:
            _register_old(found, cog, application, source)
    except (UserError, BrokenPipeError):
        raise
    except OSError as error:
        raise CogError(
            f"the cog {cog} cannot be registered: {error}", code="registration_failed"
        ) from error
    except Exception as error:
        raise CogError(
            f"the Registrant of the cog {cog} failed: {reason_of(error)}",
            code="registrant_failed",
            cog=cog,
        ) from error


def unregister(cog: str, application: Application) -> bool:
    """Unregister a cog, installed or not; return whether it was registered."""
    changed = Registry(application.root).remove(cog)
    code = "cog_unregistered" if changed else "cog_unknown"
    echo(f"{cog}: {'unregistered' if changed else 'was not registered'}", code, cog=cog)
    return changed


def find_registrant(cog: str) -> type[Any]:
    """Return the Registrant class of an installed cog; raises CogError."""
    name = f"{cog}.{REGISTRANT_MODULE}"
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name == cog:
            raise CogError(
                f"no cog {cog} is installed: list it in Cogfile.yml and run 'up gather'",
                code="not_installed",
            ) from None
        if error.name == name:
            raise CogError(
                f"{cog} is not a cog: it lacks {REGISTRANT_MODULE}.py", code="registrar_missing"
            ) from None
        raise _import_error(name, str(error)) from error
    except Exception as error:
        raise _import_error(name, reason_of(error)) from error
    for wanted in REGISTRANT_CLASSES:
        found = getattr(module, wanted, None)
        if inspect.isclass(found) and issubclass(found, UpRegistrant | UpRegistrar):
            return found
    raise CogError(
        f"{name} has no class Registrant that extends UpRegistrant", code="registrant_missing"
    )


def _import_error(name: str, reason: str) -> CogError:
    return CogError(f"{name} cannot be imported: {reason}", "import_failed", name=name)


def _check_importable(registrant: UpRegistrant, application: Application) -> None:
    """Refuse a manifest that would stop the boot; cogs already registered were checked before."""
    modules = registrant.manifest.modules
    known = Registry(application.root).entries().get(registrant.cog_name)
    if known is not None and known.modules == modules:
        return
    for each in modules:
        try:
            getattr(importlib.import_module(each.prefix), each.class_name)
        except Exception as error:
            raise CogError(
                f"the cog {registrant.cog_name} lists {each.path}, which cannot be imported:"
                f" {reason_of(error)}",
                code="import_failed",
                name=each.path,
            ) from error


def _register_old(found: type[Any], cog: str, application: Application, source: Source) -> None:
    # Old Registrars search for the application in the current directory.
    with contextlib.chdir(application.root):
        registrar = found()
        registrar.source = source
        if registrar.register() is False:
            raise CogError(
                f"the Registrar of the cog {cog} reports a failure", code="registrant_failed"
            )
        changed = registrar.finish()
    echo_registered(cog, changed)
