/* Which interrupt is taken, and when (data sheet 7.7, 12.1).
 *
 * A flag whose mask is set later still interrupts, a mask that is cleared keeps the flag: simavr
 * forgets both. Entry takes 4 cycles, which simavr does not count.
 */
#include "rig.h"


typedef struct { uint16_t flags; uint8_t flag; uint16_t masks; uint8_t mask; bool clears; } source_t;

static const source_t SOURCES[VECTORS] = {
    [3] = {R_PCIFR, 1, R_PCICR, 1, true},
    [4] = {R_PCIFR, 2, R_PCICR, 2, true},
    [5] = {R_PCIFR, 4, R_PCICR, 4, true},
    [6] = {R_WDTCSR, 0x80, R_WDTCSR, 0x40, true},
    [7] = {R_TIFR2, 2, R_TIMSK2, 2, true},
    [8] = {R_TIFR2, 4, R_TIMSK2, 4, true},
    [9] = {R_TIFR2, 1, R_TIMSK2, 1, true},
    [11] = {R_TIFR1, 2, R_TIMSK1, 2, true},
    [12] = {R_TIFR1, 4, R_TIMSK1, 4, true},
    [13] = {R_TIFR1, 1, R_TIMSK1, 1, true},
    [14] = {R_TIFR0, 2, R_TIMSK0, 2, true},
    [15] = {R_TIFR0, 4, R_TIMSK0, 4, true},
    [16] = {R_TIFR0, 1, R_TIMSK0, 1, true},
    [18] = {R_UCSR0A, 0x80, R_UCSR0B, 0x80, false},
    [19] = {R_UCSR0A, 0x20, R_UCSR0B, 0x20, false},
    [20] = {R_UCSR0A, 0x40, R_UCSR0B, 0x40, true},
    [24] = {R_TWCR, 0x80, R_TWCR, 0x01, false},
};

void interrupts_refresh(rig_t *rig) {
    const uint8_t *data = rig->avr->data;
    uint32_t pending = 0;
    for (unsigned vector = 1; vector < VECTORS; vector++) {
        const source_t *source = &SOURCES[vector];
        if (data[source->flags] & source->flag && data[source->masks] & source->mask)
            pending |= 1UL << vector;
    }
    /* EEPROM ready has no flag: it interrupts as long as nothing is being written (8.6.3). */
    if ((data[R_EECR] & 0x0A) == 0x08) pending |= 1UL << 22;
    rig->pending = pending;
}

void set_flag(rig_t *rig, uint16_t address, uint8_t bits) {
    rig->avr->data[address] |= bits;
    interrupts_refresh(rig);
}

void interrupt_enter(rig_t *rig) {
    avr_t *avr = rig->avr;
    unsigned vector = (unsigned)__builtin_ctz(rig->pending);
    const source_t *source = &SOURCES[vector];
    uint16_t stack = (uint16_t)(avr->data[R_SPL] | avr->data[R_SPH] << 8);
    if (stack < 0x102 || stack > avr->ramend) {
        note_crash(rig, "wild_stack",
                   "the stack pointer is at 0x%04x when an interrupt comes", stack);
        return;
    }
    avr->data[stack] = (uint8_t)(avr->pc >> 1);
    avr->data[stack - 1] = (uint8_t)(avr->pc >> 9);
    stack -= 2;
    avr->data[R_SPL] = (uint8_t)stack;
    avr->data[R_SPH] = (uint8_t)(stack >> 8);
    if (stack < rig->meter.stack_lowest) rig->meter.stack_lowest = stack;
    avr->sreg[S_I] = 0;
    avr->interrupt_state = 0;
    if (source->clears) avr->data[source->flags] &= (uint8_t)~source->flag;
    /* A watchdog that may both interrupt and reset resets the next time (10.9.2). */
    if (vector == 6 && avr->data[R_WDTCSR] & 8) avr->data[R_WDTCSR] &= (uint8_t)~0x40;
    rig->off_since = avr->cycle;
    rig->off_pc = (uint16_t)(vector * 4);
    if (!rig->depth++) rig->entered = avr->cycle;
    rig->meter.counts[vector]++;
    avr->cycle += avr->state == cpu_Sleeping ? 8 : 4;
    avr->state = cpu_Running;
    avr->pc = vector * 4;
    interrupts_refresh(rig);
}

/* A RETI begins. */
void interrupt_leave(rig_t *rig) {
    if (!rig->depth || --rig->depth) return;
    rig->meter.interrupt_cycles += rig->avr->cycle + 4 - rig->entered;
}

/* Flags are cleared by writing ones; SBI clears its own alone. */
static void on_flags(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    avr->data[address] &= (uint8_t)~bits_written(rig, value);
    interrupts_refresh(rig);
}

static void on_masks(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    run_events(param, write_time(param));
    avr->data[address] = value;
    interrupts_refresh(param);
}

static void on_external(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    if (value & 3)
        note_crash(param, "not_modelled",
                   "INT0 and INT1 are not modelled (EIMSK = 0x%02x)", value);
    avr->data[address] = value;
}

void interrupts_hook(rig_t *rig) {
    static const uint16_t FLAGS[] = {R_TIFR0, R_TIFR1, R_TIFR2, R_PCIFR};
    static const uint16_t MASKS[] = {R_TIMSK0, R_TIMSK1, R_TIMSK2, R_PCICR};
    for (unsigned i = 0; i < 4; i++) {
        hook_read(rig, FLAGS[i], read_register);
        hook_write(rig, FLAGS[i], on_flags);
        hook_write(rig, MASKS[i], on_masks);
    }
    hook_write(rig, R_EIMSK, on_external);
}
