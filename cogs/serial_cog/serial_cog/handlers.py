"""The handlers of each frame type."""

from collections.abc import Callable, Mapping

from up.protocols.frame import MAX_PAYLOAD

FrameHandler = Callable[[bytes], object]
FrameType = str | int | bytes


def type_byte(type_: FrameType) -> int:
    """Return the byte of a type given as letter, byte or number; raises ValueError."""
    if isinstance(type_, str | bytes):
        if len(type_) != 1:
            raise ValueError(f"a type is one byte, not {type_!r}")
        type_ = ord(type_)
    if not 0 <= type_ <= 255:
        raise ValueError(f"a type is one byte, not {type_}")
    return type_


class HandlerTable:
    """The handlers by type, and the payload sizes that they declare."""

    def __init__(self) -> None:
        self.by_type: dict[int, tuple[FrameHandler, ...]] = {}
        self._sizes: dict[int, int] = {}
        self._least: dict[int, int] = {}

    @property
    def sizes(self) -> Mapping[int, int]:
        return dict(self._sizes)

    @property
    def least(self) -> Mapping[int, int]:
        """Return the least sizes of the types that may have another size."""
        return dict(self._least)

    def add(
        self, type_: FrameType, handler: FrameHandler, payload_size: int, least: int | None = None
    ) -> bool:
        """Add a handler; return whether its type is new.

        Raises ValueError for a size outside 0 to 96 or other than an earlier handler's.
        """
        number = type_byte(type_)
        if not 0 <= payload_size <= MAX_PAYLOAD:
            raise ValueError(f"a payload has 0 to {MAX_PAYLOAD} bytes, not {payload_size}")
        is_new = number not in self._sizes
        if self._sizes.setdefault(number, payload_size) != payload_size:
            raise ValueError(
                f"type {chr(number)!r} has {self._sizes[number]} bytes of payload, not"
                f" {payload_size}"
            )
        if least is not None:
            self._least[number] = least
        self.by_type[number] = (*self.by_type.get(number, ()), handler)
        return is_new

    def remove(self, type_: FrameType, handler: FrameHandler | None = None) -> bool:
        """Remove one handler of a type, or all; return whether the type has no handlers left.

        Raises KeyError for an unknown handler.
        """
        number = type_byte(type_)
        before = self.by_type[number]
        left = () if handler is None else tuple(each for each in before if each != handler)
        if len(left) == len(before):
            raise KeyError(f"{handler!r} does not handle {chr(number)!r}")
        if left:
            self.by_type[number] = left
            return False
        del self.by_type[number], self._sizes[number]
        self._least.pop(number, None)
        return True
