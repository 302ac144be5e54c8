"""Turns an application into a running Up: discover, select, order, build (thesis 4.1.3)."""

from up.builtin_modules import BUILTIN_MODULES
from up.config.application import DISABLED_MODULES
from up.context import Context
from up.loading.application import Application
from up.loading.commands import add_commands
from up.loading.discovery import discover
from up.loading.order import order
from up.loading.plan import Plan
from up.loading.selection import select
from up.up import Up


class UpLoader:
    """Loads an application.

    ``plan`` returns what would be loaded without starting anything; ``create`` builds the system
    from it. Raises ConfigErrors, CogImportError or BootError, each with a sentence for the user.
    """

    def __init__(self, application: Application, context: Context) -> None:
        self._application = application
        self._context = context

    def plan(self) -> Plan:
        """Return the ordered modules, the Commands, and the reasons against the rest."""
        disabled = self._context.config(DISABLED_MODULES).disabled_modules or ()
        found = discover(self._application, disabled)
        plan = select(found, BUILTIN_MODULES, self._context, disabled)
        plan.modules = order(plan.modules, plan.left_out)
        add_commands(plan, found, disabled)
        return plan

    def create(self) -> Up:
        up = Up(self.plan(), self._context)
        up.initialize()
        return up
