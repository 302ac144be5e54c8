"""Which source of fixes disagrees with the estimate while another one agrees with it."""

from up.quick_dataclass import dataclass

DOUBT_S = 2.0
"""A source that disagrees for as long without a break is doubted: before a jump is believed."""
AGREEMENT_S = 1.0
"""One that is doubted and agrees for as long is believed again."""
WITNESS_S = 3.0
"""How old the newest fix of the source that agrees may be."""


@dataclass(slots=True)
class _Source:
    is_far: bool
    since_s: float
    newest_s: float
    is_doubted: bool = False


class FixSources:
    """Compares sources with the estimate; all times are monotonic seconds.

    A source alone is never doubted: the estimate may be the one that is wrong.
    """

    def __init__(self) -> None:
        self._sources: dict[str, _Source] = {}

    def note(self, source: str, is_far: bool, now_s: float) -> None:
        """Note whether a fix that arrives now is farther from the estimate than it may be."""
        known = self._sources.get(source)
        if known is None:
            known = self._sources[source] = _Source(is_far, now_s, now_s)
        if known.is_far != is_far or now_s - known.newest_s > WITNESS_S:
            known.is_far, known.since_s = is_far, now_s
        known.newest_s = now_s
        if now_s - known.since_s >= (DOUBT_S if is_far else AGREEMENT_S):
            known.is_doubted = is_far

    def is_doubted(self, source: str, now_s: float) -> bool:
        """Return whether a source is wrong by the estimate and by another source."""
        known = self._sources.get(source)
        return known is not None and known.is_doubted and self._has_witness(source, now_s)

    def _has_witness(self, than: str, now_s: float) -> bool:
        return any(
            name != than and not (each.is_far or each.is_doubted)
            and now_s - each.newest_s <= WITNESS_S
            for name, each in self._sources.items()
        )  # fmt: skip
