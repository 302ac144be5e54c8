"""Keeps a number within bounds, in a third of the time of ``max`` and ``min``."""


def limited(value: float, lowest: float, highest: float) -> float:
    """Return the value within the bounds, ``highest`` where it is not a number."""
    if value < highest:
        return value if value > lowest else lowest
    return highest
