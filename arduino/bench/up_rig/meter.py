"""The rig's measurements beside the pins: interrupt load, stack, time with interrupts off."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

from up_rig.library import Handle

VECTOR_NAMES = {
    3: "PCINT0", 4: "PCINT1", 5: "PCINT2", 6: "WDT", 7: "TIMER2_COMPA", 8: "TIMER2_COMPB",
    9: "TIMER2_OVF", 11: "TIMER1_COMPA", 12: "TIMER1_COMPB", 13: "TIMER1_OVF",
    14: "TIMER0_COMPA", 15: "TIMER0_COMPB", 16: "TIMER0_OVF", 18: "USART_RX", 19: "USART_UDRE",
    20: "USART_TX", 22: "EE_READY", 24: "TWI",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Measures:
    """Cycles are of 62.5 ns and count from an interrupt's entry to the end of its RETI.

    ``longest_off_at`` is the address of the instruction (or vector) that began the longest time
    with interrupts off. ``stack_lowest`` is the lowest stack pointer, 0x8FF when unused;
    ``resets`` counts power-on, external, brown-out and watchdog.
    """

    interrupt_cycles: int
    interrupts: dict[str, int]
    longest_off_cycles: int
    longest_off_at: int
    sleep_cycles: int
    stack_lowest: int
    resets: tuple[int, int, int, int]

    @property
    def stack_bytes(self) -> int:
        """Return the most bytes that the stack took."""
        return 0x8FF - self.stack_lowest


def read_measures(library: ctypes.CDLL, handle: Handle) -> Measures:
    """Return the measures of a rig."""
    meter = library.rig_meter(handle).contents
    return Measures(
        interrupt_cycles=meter.interrupt_cycles,
        interrupts={name: meter.counts[at] for at, name in VECTOR_NAMES.items()},
        longest_off_cycles=meter.longest_off,
        longest_off_at=meter.longest_off_pc,
        sleep_cycles=meter.sleep_cycles,
        stack_lowest=meter.stack_lowest,
        resets=tuple(meter.resets),
    )
