"""The action of a Command as an object (thesis 4.1.4)."""

from abc import ABC, abstractmethod
from typing import Any

from twisted.logger import Logger

from up.commands.command import BaseCommand


class BaseCommandHandler(ABC):
    """Carries out one Command; register it with ``CommandExecutor.register_command``.

    ``COMMAND`` names the Command that a handler in the application's ``commands/`` folder takes;
    such a handler is registered automatically.
    """

    COMMAND: type[BaseCommand] | str = ""

    @property
    def log(self) -> Logger:
        return Logger(namespace=type(self).__name__)

    @property
    def logger(self) -> Logger:
        return self.log

    @abstractmethod
    def run_action(self, command: Any) -> Any:
        """Carry the Command out, on the reactor thread, without blocking.

        Raise CommandRefusedError to refuse; return a Deferred for a later outcome.
        """
