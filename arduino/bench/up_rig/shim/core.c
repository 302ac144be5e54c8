/* The bench: makes the chip, runs it to a cycle, resets it.
 *
 * Instructions are run by simavr's avr_run_one; its own loop, cycle timers, interrupt queue, sleep
 * and resets are not used, as a watchdog reset would drop every timer and a sleeping chip would
 * make the process sleep. It runs one instruction at a time while the rig measures, and otherwise
 * up to the next event or the next access to a register.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"

enum { SPM = 0x95E8 };

avr_flashaddr_t avr_run_one(avr_t *avr);

/* ---- time of a register access ---- */
static uint16_t opcode(const avr_t *avr) {
    return (uint16_t)(avr->flash[avr->pc] | avr->flash[avr->pc + 1] << 8);
}

static unsigned access_cycles(const avr_t *avr) {
    return (opcode(avr) & 0xF000) == 0xB000 ? 1 : 2; /* IN and OUT; SBI, CBI, loads, stores */
}

/* A register access may concern the next instruction: the run of instructions ends here. */
static cycle_t end_run(const rig_t *rig) {
    rig->avr->run_cycle_count = 1;
    return rig->avr->cycle + access_cycles(rig->avr);
}

cycle_t read_time(const rig_t *rig) { return end_run(rig) - 1; }
cycle_t write_time(const rig_t *rig) { return end_run(rig); }

uint8_t bits_written(const rig_t *rig, uint8_t value) {
    uint16_t code = opcode(rig->avr);
    return (code & 0xFF00) == 0x9A00 ? (uint8_t)(1 << (code & 7)) : value;
}

void hook_read(rig_t *rig, uint16_t address, avr_io_read_t function) {
    rig->avr->io[AVR_DATA_TO_IO(address)].r.c = function;
    rig->avr->io[AVR_DATA_TO_IO(address)].r.param = rig;
}

void hook_write(rig_t *rig, uint16_t address, avr_io_write_t function) {
    rig->avr->io[AVR_DATA_TO_IO(address)].w.c = function;
    rig->avr->io[AVR_DATA_TO_IO(address)].w.param = rig;
}

uint8_t read_register(avr_t *avr, avr_io_addr_t address, void *param) {
    run_events(param, read_time(param));
    return avr->data[address];
}

void note_crash(rig_t *rig, const char *code, const char *format, unsigned value) {
    if (rig->crash_code) return;
    snprintf(rig->crash_text, sizeof rig->crash_text, format, value);
    rig->crash_code = code;
}

uint32_t next_random(rig_t *rig) {
    uint32_t x = rig->random;
    x ^= x << 13, x ^= x >> 17, x ^= x << 5;
    return rig->random = x;
}

/* simavr only logs some faults and continues: here such a program is stopped. */
static void on_log(avr_t *avr, const int level, const char *format, va_list arguments) {
    (void)format, (void)arguments;
    if (avr && avr->custom.data && level <= LOG_ERROR)
        note_crash(avr->custom.data, "wild_program",
                   "the program went wild at address 0x%04x", avr->pc);
}

/* ---- events ---- */
static cycle_t least(cycle_t one, cycle_t other) { return one < other ? one : other; }

void replan(rig_t *rig) {
    cycle_t due = rig->queue.count ? rig->queue.items[0].cycle : NEVER;
    due = least(due, uart_due(rig));
    if (!rig->reset_until) {
        due = least(due, timers_due(rig));
        due = least(due, least(rig->twi.due, rig->watchdog.due));
    }
    rig->next_due = least(due, rig->eeprom.done);
    rig->is_planned = true;
}

void run_events(rig_t *rig, cycle_t now) {
    if (!rig->is_planned) replan(rig);
    while (rig->next_due <= now) {
        cycle_t when = rig->next_due;
        while (rig->queue.count && rig->queue.items[0].cycle <= when) {
            event_t event = queue_take(&rig->queue);
            if (event.kind == EVENT_PIN) port_drive(rig, event.a, event.b, event.cycle);
            else if (!rig->reset_until) pin_flag(rig, event.a);
        }
        uart_run(rig, when);
        if (!rig->reset_until) {
            timers_run(rig, when);
            twi_run(rig, when);
            watchdog_run(rig, when);
        }
        eeprom_run(rig, when);
        replan(rig);
    }
}

/* ---- reset ---- */
void want_reset(rig_t *rig, uint8_t cause) { rig->reset_wanted |= cause; }

static void reset(rig_t *rig) {
    avr_t *avr = rig->avr;
    uint8_t cause = rig->reset_wanted;
    uint8_t causes = cause & RESET_POWER ? RESET_POWER : avr->data[R_MCUSR] | cause;
    memset(avr->data + 0x20, 0, 0xE0);
    memset(avr->sreg, 0, sizeof avr->sreg);
    avr->data[R_SPL] = (uint8_t)avr->ramend;
    avr->data[R_SPH] = (uint8_t)(avr->ramend >> 8);
    avr->data[R_MCUSR] = causes;
    avr->pc = avr->reset_pc;
    avr->state = cpu_Running;
    avr->interrupt_state = 0;
    rig->reset_wanted = 0;
    rig->depth = 0;
    rig->off_since = NEVER;
    for (int i = 0; i < 4; i++) rig->meter.resets[i] += cause >> i & 1;
    rig->reset_until = avr->cycle + rig->start_up;
    timers_reset(rig, rig->reset_until);
    twi_reset(rig);
    adc_reset(rig);
    uart_reset(rig);
    eeprom_reset(rig);
    ports_reset(rig, avr->cycle);
    watchdog_reset(rig, rig->reset_until, cause);
    interrupts_refresh(rig);
    replan(rig);
}

/* ---- running ---- */
static void note_stack(rig_t *rig, uint16_t code) {
    /* Where the stack pointer moves down; a half-written pair does not count as a stack. */
    bool is_push = (code & 0xFE0F) == 0x920F, is_call = (code & 0xFE0E) == 0x940E;
    bool is_relative = (code & 0xF000) == 0xD000, is_indirect = code == 0x9509;
    bool is_low_byte = (code & 0xFE0F) == 0xBE0D;
    if (!is_push && !is_call && !is_relative && !is_indirect && !is_low_byte) return;
    const uint8_t *data = rig->avr->data;
    uint16_t stack = (uint16_t)(data[R_SPL] | data[R_SPH] << 8);
    if (stack < rig->meter.stack_lowest) rig->meter.stack_lowest = stack;
}

static void note_interrupts_on(rig_t *rig) {
    /* Before a program first allows them nothing waits for them. */
    if (rig->off_since == NEVER) return;
    uint64_t off = rig->avr->cycle - rig->off_since;
    if (off > rig->meter.longest_off) {
        rig->meter.longest_off = (uint32_t)off;
        rig->meter.longest_off_pc = rig->off_pc;
    }
}

static void preload(rig_t *rig) {
    for (int i = 0; i < rig->preload_count; i++)
        memcpy(rig->avr->data + rig->preloads[i].address, rig->preloads[i].bytes,
               rig->preloads[i].size);
    rig->break_pc = UINT32_MAX;
}

/* CPSE, SBRC, SBRS, SBIC, SBIS in front of ADIW or SBIW. */
static bool skips_addition(const avr_t *avr) {
    uint16_t code = opcode(avr);
    bool is_skip = (code & 0xFC00) == 0x1000 || (code & 0xFC08) == 0xFC00 || (code & 0xFD00) == 0x9900;
    return is_skip && (avr->flash[avr->pc + 3] & 0xFE) == 0x96;
}

static void run_one(rig_t *rig) {
    avr_t *avr = rig->avr;
    bool writes_flash = opcode(avr) == SPM;
    uint32_t beyond = skips_addition(avr) ? avr->pc + 6 : UINT32_MAX;
    avr->run_cycle_count = 1;
    avr->pc = avr_run_one(avr);
    /* simavr takes some constants of ADIW for a second word, and skips one too many. */
    if (avr->pc == beyond) avr->pc -= 2, avr->cycle--;
    if (writes_flash) quick_discard(rig);
}

static void step(rig_t *rig, cycle_t until) {
    avr_t *avr = rig->avr;
    if (avr->pc == rig->break_pc) preload(rig);
    if (!rig->is_planned) replan(rig);
    bool is_stepping = rig->is_measuring || rig->break_pc != UINT32_MAX ||
                       (rig->pending && avr->sreg[S_I]);
    uint16_t code = opcode(avr);
    uint8_t was_on = avr->sreg[S_I];
    uint32_t pc = avr->pc;
    cycle_t end = least(rig->next_due, until);
    avr->interrupt_state = 0;
    if (is_stepping || end <= avr->cycle || quick_run(rig, end)) run_one(rig);
    if (rig->is_measuring) {
        if (was_on && !avr->sreg[S_I]) {
            rig->off_since = avr->cycle;
            rig->off_pc = (uint16_t)pc;
        } else if (!was_on && avr->sreg[S_I]) {
            note_interrupts_on(rig);
        }
        note_stack(rig, code);
    }
    if (avr->state == cpu_Crashed || avr->state == cpu_Stopped)
        note_crash(rig, "wild_program", "the program went wild at address 0x%04x", avr->pc);
    if (avr->cycle >= rig->next_due || !rig->is_planned) run_events(rig, avr->cycle);
    /* The instruction after the one that allows interrupts always runs (7.7); simavr marks that
     * one by its own state. */
    if (rig->pending && avr->sreg[S_I] && !avr->interrupt_state && !rig->reset_wanted)
        interrupt_enter(rig);
}

static void sleep(rig_t *rig, cycle_t until) {
    avr_t *avr = rig->avr;
    if (rig->pending && avr->sreg[S_I]) {
        interrupt_enter(rig);
        return;
    }
    if (!rig->is_planned) replan(rig);
    cycle_t next = least(rig->next_due, until);
    if (next > avr->cycle) {
        rig->meter.sleep_cycles += next - avr->cycle;
        avr->cycle = next;
    }
    run_events(rig, avr->cycle);
}

const char *rig_run(rig_t *rig, cycle_t until) {
    avr_t *avr = rig->avr;
    while (avr->cycle < until && !rig->crash_code) {
        if (rig->reset_wanted) reset(rig);
        if (rig->reset_until) {
            avr->cycle = least(rig->reset_until, until);
            run_events(rig, avr->cycle);
            if (avr->cycle >= rig->reset_until) {
                rig->reset_until = 0;
                rig->is_planned = false;
            }
        } else if (avr->state == cpu_Sleeping) {
            sleep(rig, until);
        } else {
            step(rig, until);
        }
    }
    return rig->crash_code ? rig->crash_text : NULL;
}

/* ---- making ---- */
typedef struct { avr_io_t io; rig_t *rig; } wdr_t;

static int on_ioctl(avr_io_t *io, uint32_t request, void *parameter) {
    (void)parameter;
    if (request != AVR_IOCTL_DEF('w', 'd', 't', 'r')) return -1;
    watchdog_feed(((wdr_t *)io)->rig);
    ((wdr_t *)io)->rig->avr->run_cycle_count = 1;
    return 0;
}

/* simavr reports a RETI with an interrupt number, here always 0 because it knows of none. */
static void on_return(avr_irq_t *irq, uint32_t value, void *parameter) {
    (void)irq, (void)value;
    interrupt_leave(parameter);
}

rig_t *rig_new(uint32_t seed) {
    avr_global_logger_set(on_log);
    avr_t *avr = avr_make_mcu_by_name("atmega328p");
    if (!avr) return NULL;
    avr_init(avr);
    avr->frequency = CYCLES_PER_US * 1000000;
    /* A wild pointer reaches 64 KB of data and 128 KB of flash; simavr logs it and continues. */
    avr->data = realloc(avr->data, 0x10100);
    avr->flash = realloc(avr->flash, 0x20100);
    memset(avr->data, 0, 0x10100);
    memset(avr->flash, 0xFF, 0x20100);
    rig_t *rig = calloc(1, sizeof *rig);
    rig->avr = avr;
    avr->custom.data = rig;
    for (int i = 0; i < MAX_IOs; i++) {
        if (i + 0x20 == R_SPMCSR) continue;
        memset(&avr->io[i], 0, sizeof avr->io[i]);
    }
    wdr_t *wdr = calloc(1, sizeof *wdr);
    wdr->rig = rig;
    wdr->io.kind = "rig";
    wdr->io.ioctl = on_ioctl;
    avr_register_io(avr, &wdr->io);
    rig->random = seed ? seed : 1;
    rig->break_pc = UINT32_MAX;
    rig->meter.stack_lowest = (uint16_t)avr->ramend;
    rig->start_up = 66000 * CYCLES_PER_US; /* 16K CK + 65 ms, SUT of the Nano and the Uno (9.3) */
    rig->imu.address = rig->imu.identity = 0x68;
    rig->imu.is_present = true;
    rig->is_measuring = true;
    avr_irq_register_notify(avr->interrupts.irq + AVR_INT_IRQ_RUNNING, on_return, rig);
    interrupts_hook(rig);
    ports_hook(rig);
    timers_hook(rig);
    uart_hook(rig);
    twi_hook(rig);
    eeprom_hook(rig);
    watchdog_hook(rig);
    adc_hook(rig);
    return rig;
}

void rig_free(rig_t *rig) {
    free(rig->edges.items);
    free(rig->sent.items);
    free(rig->queue.items);
    free(rig->uart.line);
    free(rig->quick);
    avr_terminate(rig->avr);
    free(rig->avr);
    free(rig);
}
