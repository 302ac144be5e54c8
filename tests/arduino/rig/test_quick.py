"""What runs without simavr comes to the same registers, memory and cycles as simavr."""

import random

import pytest

from tests.arduino.rig.firmware import make_rig, rig_with
from tests.support.firmware import build_firmware
from up_rig import CrashError
from up_rig.imu import motion_at
from up_simulator.firmware.wire import checked_frame

WORDS, RUN_CYCLES = 2000, 6000
RAM_END = 0x900
SREG_AT = 0x600
# (bits that are fixed, their values); fractional products and BSET are simavr's own in both.
PLAIN = [
    *((0xFC00, code << 10) for code in (1, 2, 3, 5, 6, 7, 8, 9, 10, 11)),
    *((0xF000, code << 12) for code in (3, 4, 5, 6, 7, 14)),
    (0xFFFF, 0x0000), (0xFF00, 0x0100), (0xFF00, 0x0200), (0xFF00, 0x0300), (0xFC00, 0x9C00),
    *((0xFE0F, 0x9400 | code) for code in (0, 1, 2, 3, 5, 6, 7, 10)),
    (0xFF00, 0x9600), (0xFF00, 0x9700), (0xFE08, 0xF800), (0xFE08, 0xFA00), (0xFF8F, 0x9408),
    (0xFF8F, 0x9488), (0xFFFF, 0x95C8), (0xFE0F, 0x9004), (0xFE0F, 0xB60F), (0xFE0F, 0xB60D),
    (0xFE0F, 0xBE0F),
]  # fmt: skip
SKIPS = [(0xFE08, 0xFC00), (0xFE08, 0xFE00), (0xFC00, 0x1000)]
# Through X, Y and Z: plain or displaced, then counting up, then counting down.
LOADS = {26: (0x900C, 0x900D, 0x900E), 28: (0x8008, 0x9009, 0x900A), 30: (0x8000, 0x9001, 0x9002)}


class Writer:
    """Writes a program that ends where it begins to wait, with its flags kept at SREG_AT."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.words = []
        kinds = [self.plain] * 12 + [self.skip, self.branch, self.memory, self.memory, self.stack]
        kinds += [self.direct, self.jump, self.call, self.back, *[self.witness] * 6]
        while len(self.words) < WORDS:
            self.random.choice(kinds)()
        # in r16,SREG; sts SREG_AT,r16; rjmp .
        self.words += [0xB70F, 0x9300, SREG_AT, 0xCFFF]

    @property
    def code(self):
        return b"".join(word.to_bytes(2, "little") for word in self.words)

    def some(self, kinds):
        mask, fixed = self.random.choice(kinds)
        self.words.append(fixed | self.random.getrandbits(16) & ~mask & 0xFFFF)

    def plain(self):
        self.some(PLAIN)

    def set_register(self, register, value):
        self.words.append(0xE000 | (register - 16) << 4 | (value & 0xF0) << 4 | value & 15)

    def set_pair(self, register, value):
        self.set_register(register, value & 0xFF)
        self.set_register(register + 1, value >> 8)

    def witness(self):
        """Store the current flags in their own place: in r16,SREG; sts ..,r16."""
        self.words += [0xB70F, 0x9300, SREG_AT + self.random.randrange(1, 0x200)]

    def skip(self):
        self.some(SKIPS)
        self.random.choice((self.plain, self.direct))()

    def branch(self):
        self.words.append(
            0xF000 | self.random.getrandbits(11) & 0x407 | self.random.randrange(4) << 3
        )
        for _ in range(4):
            self.plain()

    def memory(self):
        pair = self.random.choice((26, 28, 30))
        self.set_pair(pair, self.random.randrange(0x110, SREG_AT - 0x40))
        code = self.random.choice(LOADS[pair]) | self.random.randrange(24) << 4
        if code & 0xF000 == 0x8000:
            code |= self.random.getrandbits(16) & 0x2C07
        self.words.append(code | self.random.choice((0, 0x0200)))

    def direct(self):
        store = self.random.choice((0, 0x0200))
        self.words += [0x9000 | store | self.random.randrange(32) << 4,
                       self.random.randrange(0x100, SREG_AT)]  # fmt: skip

    def stack(self):
        self.words.append(0x920F | self.random.randrange(32) << 4)
        self.plain()
        self.words.append(0x900F | self.random.randrange(32) << 4)

    def jump(self):
        after = len(self.words) + 2
        kind = self.random.randrange(3)
        if kind == 0:
            self.words += [0x940C, after]
        elif kind == 1:
            self.words += [0xC001, 0xFFFF]
        else:
            self.set_pair(30, after + 1)
            self.words.append(0x9409)

    def call(self):
        after = len(self.words) + 2
        kind = self.random.randrange(3)
        if kind == 0:
            self.words += [0x940E, after]
        elif kind == 1:
            self.words += [0xD001, 0xFFFF]
        else:
            self.set_pair(30, after + 1)
            self.words.append(0x9509)
        self.words += [0x910F, 0x911F]

    def back(self):
        after = len(self.words) + 5
        self.set_register(16, after & 0xFF)
        self.words.append(0x930F)
        self.set_register(16, after >> 8)
        self.words += [0x930F, 0x9508]


def memory(rig):
    """Return registers and RAM (the range between them belongs to the peripherals)."""
    data = rig._library.rig_data(rig._handle)
    return bytes(data[:32]) + bytes(data[0x5D:0x5F]) + bytes(data[0x100:RAM_END])


def ran(folder, code, is_measuring):
    rig = rig_with("pins", folder, is_measuring=is_measuring, start_up_us=1, seed=5)
    rig.write_flash(0, code)
    steps = []
    for until in range(500, RUN_CYCLES, 500):
        rig.run_until_cycle(until)
        steps.append((rig.cycle, memory(rig)))
    return steps


@pytest.mark.parametrize("seed", range(25))
def test_random_code_is_run_as_simavr_does(tmp_path, seed):
    code = Writer(seed).code
    assert ran(tmp_path, code, is_measuring=False) == ran(tmp_path, code, is_measuring=True)


@pytest.mark.parametrize("skip", [0xFD97, 0x1000, 0x991F])
def test_a_skipped_addition_of_a_large_constant_is_one_word(tmp_path, skip):
    # The skip; adiw r24,15; ldi r16,5; rjmp . - simavr alone takes adiw of 12 to 15 for two words.
    words = [skip, 0x960F, 0xE005, 0xCFFF]
    code = b"".join(word.to_bytes(2, "little") for word in words)
    for is_measuring in (False, True):
        rig = rig_with("pins", tmp_path, is_measuring=is_measuring, start_up_us=1)
        rig.write_flash(0, code)
        rig.run_us(100)
        registers = memory(rig)
        assert (registers[16], registers[24]) == (5, 0), is_measuring


def flown(is_measuring):
    rig = make_rig(build_firmware(), is_measuring=is_measuring)
    rig.receiver.sticks(aux1=1500)
    rig.receiver.start()
    rig.run_us(1_200_000)
    rig.serial.write(b"\0" + checked_frame(0, "s"))
    rig.imu.motion = motion_at(30, -10)
    rig.run_us(300_000)
    rig.force_watchdog_reset()
    rig.run_us(300_000)
    pulses = [rig.servo.pulses(each) for each in ("ailerons", "elevator", "throttle", "rudder")]
    return rig.cycle, memory(rig), rig.serial.read_stamped(), pulses


def test_the_firmware_flies_alike_to_the_cycle():
    assert flown(is_measuring=False) == flown(is_measuring=True)


def test_an_interrupt_is_let_in_at_the_same_cycle(tmp_path):
    came = []
    for is_measuring in (False, True):
        rig = rig_with("let_in", tmp_path, is_measuring=is_measuring, start_up_us=1)
        rig.run_us(1000)
        came.append((rig.cycle, memory(rig)))
        assert rig.measures().interrupts["TIMER1_COMPA"] > 100
    assert came[0] == came[1]


def test_a_stack_that_leaves_the_ram_is_still_a_crash(tmp_path):
    # ldi r16,1; out SPH,r16; out SPL,r16; push r16 (four times)
    words = [0xE001, 0xBF0E, 0xBF0D, 0x930F, 0x930F, 0x930F, 0x930F, 0xCFFB]
    code = b"".join(word.to_bytes(2, "little") for word in words)
    texts = []
    for is_measuring in (False, True):
        rig = rig_with("pins", tmp_path, is_measuring=is_measuring, start_up_us=1)
        rig.write_flash(0, code)
        with pytest.raises(CrashError) as crash:
            rig.run_us(1000)
        texts.append(str(crash.value))
    assert texts[0] == texts[1]


def test_code_that_changes_while_it_runs_is_run_as_it_is_now(tmp_path):
    rig = rig_with("pins", tmp_path, is_measuring=False, start_up_us=1)
    # inc r16; rjmp back
    rig.write_flash(0, bytes.fromhex("0395fecf"))
    rig.run_us(10)
    rig.write_flash(0, bytes.fromhex("0000"))
    before = memory(rig)[16]
    rig.run_us(100)
    assert memory(rig)[16] == before
