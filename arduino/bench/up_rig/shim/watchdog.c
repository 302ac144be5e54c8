/* The watchdog (data sheet 10.8, 10.9): it interrupts, resets, or both in turn. */
#include "rig.h"

enum { WDIF = 0x80, WDIE = 0x40, WDCE = 0x10, WDE = 0x08, PRESCALER = 0x27, WDRF = 8 };
enum { MIN_US = 16000 };

static void restart(rig_t *rig, cycle_t now) {
    uint8_t control = rig->avr->data[R_WDTCSR];
    unsigned scale = (control & 7) | (control & 0x20 ? 8 : 0);
    rig->watchdog.due = NEVER;
    if (control & (WDE | WDIE))
        rig->watchdog.due = now + (cycle_t)(rig->watchdog.factor * MIN_US * CYCLES_PER_US *
                                            (double)(1u << scale));
    rig->is_planned = false;
}

void watchdog_feed(rig_t *rig) { restart(rig, rig->avr->cycle); }

void watchdog_run(rig_t *rig, cycle_t now) {
    if (rig->watchdog.due > now) return;
    cycle_t when = rig->watchdog.due;
    uint8_t control = rig->avr->data[R_WDTCSR];
    if (control & WDIE) {
        set_flag(rig, R_WDTCSR, WDIF);
        restart(rig, when);
    } else {
        rig->watchdog.due = NEVER;
        want_reset(rig, RESET_WATCHDOG);
    }
    rig->is_planned = false;
}

static void on_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    cycle_t now = write_time(rig);
    run_events(rig, now);
    uint8_t old = avr->data[address];
    bool may_change = now <= rig->watchdog.change_until;
    uint8_t flag = old & WDIF & (uint8_t)~value;
    uint8_t next = (uint8_t)((value & WDIE) | flag);
    if (may_change) next |= value & (WDE | PRESCALER);
    else next |= (old & (WDE | PRESCALER)) | (value & WDE);
    if (value & WDCE && value & WDE) rig->watchdog.change_until = now + 4;
    else if (may_change) rig->watchdog.change_until = 0;
    if (avr->data[R_MCUSR] & WDRF) next |= WDE; /* WDRF overrides (10.9.2) */
    avr->data[address] = next;
    bool is_on = next & (WDE | WDIE);
    bool was_on = old & (WDE | WDIE);
    if (is_on != was_on || (next ^ old) & PRESCALER) restart(rig, now);
    interrupts_refresh(rig);
}

void watchdog_reset(rig_t *rig, cycle_t now, uint8_t cause) {
    rig->watchdog.change_until = 0;
    /* After its own reset it stays on at its shortest time. */
    rig->avr->data[R_WDTCSR] = cause == RESET_WATCHDOG ? WDE : 0;
    restart(rig, now);
}

void watchdog_hook(rig_t *rig) {
    rig->watchdog.factor = 1.0;
    rig->watchdog.due = NEVER;
    hook_write(rig, R_WDTCSR, on_write);
}

/* How much slower than 128 kHz its oscillator runs. */
void rig_watchdog_factor(rig_t *rig, double factor) { rig->watchdog.factor = factor; }
