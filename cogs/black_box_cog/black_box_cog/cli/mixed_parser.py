"""Options between positional arguments."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any


class MixedParser(argparse.ArgumentParser):
    """A parser that, with ``is_mixed``, takes a list of positional arguments around its options.

    argparse gives such a list nothing that comes after an option: it offers
    ``parse_intermixed_args`` for that, but not to the parsers below a verb.
    """

    is_mixed = False

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; what it calls comes here again and goes the usual way."""
        if not self.is_mixed:
            return super().parse_known_args(args, namespace)
        self.is_mixed = False
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self.is_mixed = True
