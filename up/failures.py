"""What a module reports to the failsafes."""

from abc import abstractmethod
from collections.abc import Mapping


class FailureSource:
    """A second base class of a module that knows of failures in flight.

    ``failsafe.yml`` gives the reaction to each code.
    """

    @property
    @abstractmethod
    def failures(self) -> Mapping[str, bool]:
        """Return every code, and whether its failure holds now; read five times a second."""
