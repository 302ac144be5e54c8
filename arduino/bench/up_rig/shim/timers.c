/* Timers 0, 1 and 2 in normal mode (data sheet 15 to 18).
 *
 * A match occurs at the tick that leaves the compare value, whatever was written before: a value
 * that the counter has passed matches in the next round, one that is written while the counter
 * stands on it matches immediately. simavr shifts matches when a register is written between them,
 * moves pins at overflows, reads counts that rounding made wrong, and has no shared TEMP.
 * Other modes only count; that is reported when something depends on them.
 */
#include "rig.h"

static const uint16_t CONTROL_A[TIMERS] = {R_TCCR0A, R_TCCR1A, R_TCCR2A};
static const uint16_t FLAGS[TIMERS] = {R_TIFR0, R_TIFR1, R_TIFR2};
/* OC0A PD6, OC0B PD5, OC1A PB1, OC1B PB2, OC2A PB3, OC2B PD3 */
static const uint8_t PINS[TIMERS][2] = {{22, 21}, {1, 2}, {3, 19}};
static const uint16_t DIVIDERS[2][8] = {
    {0, 1, 8, 64, 256, 1024, 0, 0},
    {0, 1, 8, 32, 64, 128, 256, 1024},
};

static rig_timer_t *timer_of(rig_t *rig, avr_io_addr_t address) {
    if (address >= 0xB0) return &rig->timers[2];
    return &rig->timers[address >= 0x80 ? 1 : 0];
}

static cycle_t last_tick(const rig_timer_t *timer, cycle_t now) {
    return timer->origin + (now - timer->origin) / timer->divider * timer->divider;
}

static uint16_t count(const rig_timer_t *timer, cycle_t now) {
    if (!timer->divider) return timer->value;
    return (uint16_t)(timer->value + (now - timer->origin) / timer->divider) & timer->mask;
}

/* When the counter next leaves a value, after now. */
static cycle_t leaves(const rig_timer_t *timer, uint16_t value, cycle_t now) {
    if (!timer->divider) return NEVER;
    cycle_t ticks = (cycle_t)((value - count(timer, now)) & timer->mask) + 1;
    return last_tick(timer, now) + ticks * timer->divider;
}

static void plan(rig_t *rig, rig_timer_t *timer, cycle_t now) {
    for (int side = 0; side < 2; side++) {
        timer->due[side] = leaves(timer, timer->compare[side], now);
        if (timer->due[side] == timer->blocked && timer->divider)
            timer->due[side] += (cycle_t)(timer->mask + 1) * timer->divider;
    }
    timer->due[2] = leaves(timer, timer->mask, now);
    rig->is_planned = false;
}

static uint8_t output_mode(const rig_t *rig, const rig_timer_t *timer, int side) {
    return rig->avr->data[CONTROL_A[timer->number]] >> (side ? 4 : 6) & 3;
}

static void show(rig_t *rig, const rig_timer_t *timer, int side, bool latch, cycle_t now) {
    bool is_taken = output_mode(rig, timer, side) != 0;
    port_take(rig, PINS[timer->number][side], is_taken, latch, now);
}

static bool latch_of(const rig_t *rig, const rig_timer_t *timer, int side) {
    uint8_t pin = PINS[timer->number][side];
    return rig->ports[pin / 8].latch >> pin % 8 & 1;
}

static void match(rig_t *rig, const rig_timer_t *timer, int side, cycle_t now) {
    uint8_t mode = output_mode(rig, timer, side);
    if (mode) show(rig, timer, side, mode == 1 ? !latch_of(rig, timer, side) : mode == 3, now);
}

cycle_t timers_due(const rig_t *rig) {
    cycle_t due = NEVER;
    for (int i = 0; i < TIMERS; i++)
        for (int side = 0; side < 3; side++)
            if (rig->timers[i].due[side] < due) due = rig->timers[i].due[side];
    return due;
}

void timers_run(rig_t *rig, cycle_t now) {
    for (int i = 0; i < TIMERS; i++) {
        rig_timer_t *timer = &rig->timers[i];
        for (int side = 0; side < 3; side++) {
            if (timer->due[side] > now) continue;
            cycle_t when = timer->due[side];
            timer->due[side] += (cycle_t)(timer->mask + 1) * timer->divider;
            set_flag(rig, FLAGS[i], (uint8_t)(side == 2 ? 1 : 2 << side));
            if (side < 2) match(rig, timer, side, when);
        }
    }
    rig->is_planned = false;
}

/* The counter's clock changes: it keeps its count; ticks come from the shared prescaler. */
static void set_clock(rig_t *rig, rig_timer_t *timer, cycle_t now) {
    static const uint16_t CONTROL_B[TIMERS] = {R_TCCR0B, R_TCCR1B, R_TCCR2B};
    const uint8_t *data = rig->avr->data;
    bool is_two = timer->number == 2;
    uint8_t select = data[CONTROL_B[timer->number]] & 7;
    bool is_held = data[R_GTCCR] & 0x80 && data[R_GTCCR] & (is_two ? 2 : 1);
    timer->value = count(timer, now);
    timer->divider = is_held ? 0 : DIVIDERS[is_two][select];
    timer->origin = now;
    if (timer->divider)
        timer->origin -= (now - rig->prescaler_zero[is_two]) % timer->divider;
    if (!is_two && select >= 6)
        note_crash(rig, "not_modelled", "timer clock %u is not modelled", select);
    plan(rig, timer, now);
}

static void on_control_b(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    rig_timer_t *timer = timer_of(rig, address);
    cycle_t now = write_time(rig);
    run_events(rig, now);
    bool has_force = timer->number != 1;
    avr->data[address] = has_force ? value & 0x3F : value;
    for (int side = 0; has_force && side < 2; side++)
        if (value & (side ? 0x40 : 0x80)) match(rig, timer, side, now);
    set_clock(rig, timer, now);
}

static void on_force(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    avr->data[address] = 0;
    for (int side = 0; side < 2; side++)
        if (value & (side ? 0x40 : 0x80)) match(rig, &rig->timers[1], side, write_time(rig));
}

static void on_control_a(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    rig_timer_t *timer = timer_of(rig, address);
    cycle_t now = write_time(rig);
    run_events(rig, now);
    avr->data[address] = value;
    if (value & 3 && value & 0xF0)
        note_crash(rig, "not_modelled",
                   "pulse width modes are not modelled (TCCRnA = 0x%02x)", value);
    for (int side = 0; side < 2; side++)
        show(rig, timer, side, latch_of(rig, timer, side), now);
}

/* GTCCR stops and zeroes prescalers, so that timers can be started in step (17.3). */
static void on_prescaler(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    cycle_t now = write_time(rig);
    run_events(rig, now);
    uint8_t old = avr->data[address];
    for (int two = 0; two < 2; two++) {
        uint8_t bit = two ? 2 : 1;
        bool was_held = old & 0x80 && old & bit;
        if (!(value & bit) && !was_held) continue;
        for (int i = two ? 2 : 0; i < (two ? 3 : 2); i++) {
            rig->timers[i].value = count(&rig->timers[i], now);
            rig->timers[i].origin = now;
        }
        rig->prescaler_zero[two] = now;
    }
    avr->data[address] = value & 0x80 ? value & 0x83 : 0;
    for (int i = 0; i < TIMERS; i++) set_clock(rig, &rig->timers[i], now);
}

uint8_t timers_read_count(rig_t *rig, uint16_t address, cycle_t when) {
    uint16_t value = count(timer_of(rig, address), when);
    if (address == R_TCNT1L) rig->temp = (uint8_t)(value >> 8);
    return (uint8_t)value;
}

static uint8_t on_count_read(avr_t *avr, avr_io_addr_t address, void *param) {
    (void)avr;
    return timers_read_count(param, address, read_time(param));
}

static uint8_t on_temp_read(avr_t *avr, avr_io_addr_t address, void *param) {
    (void)avr, (void)address;
    return ((rig_t *)param)->temp;
}

static void on_temp_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    (void)avr, (void)address;
    ((rig_t *)param)->temp = value;
}

static void on_count_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    (void)avr;
    rig_timer_t *timer = timer_of(rig, address);
    cycle_t now = write_time(rig);
    run_events(rig, now);
    if (timer->divider) {
        timer->origin = last_tick(timer, now);
        timer->blocked = timer->origin + timer->divider;
    }
    timer->value = timer->number == 1 ? (uint16_t)(rig->temp << 8 | value) : value;
    plan(rig, timer, now);
}

static int side_of(avr_io_addr_t address) {
    return address == R_OCR0B || address == R_OCR1BL || address == R_OCR2B;
}

static uint8_t on_compare_read(avr_t *avr, avr_io_addr_t address, void *param) {
    rig_t *rig = param;
    (void)avr;
    bool is_high = address == R_OCR1AH || address == R_OCR1BH;
    uint16_t value = timer_of(rig, address)->compare[side_of(is_high ? address - 1 : address)];
    return (uint8_t)(is_high ? value >> 8 : value);
}

static void on_compare_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    (void)avr;
    rig_timer_t *timer = timer_of(rig, address);
    cycle_t now = write_time(rig);
    run_events(rig, now);
    timer->compare[side_of(address)] = timer->number == 1 ? (uint16_t)(rig->temp << 8 | value) : value;
    plan(rig, timer, now);
}

void timers_reset(rig_t *rig, cycle_t now) {
    rig->prescaler_zero[0] = rig->prescaler_zero[1] = now;
    for (uint8_t i = 0; i < TIMERS; i++)
        rig->timers[i] = (rig_timer_t){
            .number = i, .mask = i == 1 ? 0xFFFF : 0xFF, .blocked = NEVER,
            .due = {NEVER, NEVER, NEVER}};
    for (uint8_t i = 0; i < PORTS; i++) rig->ports[i].latch = 0;
}

void timers_hook(rig_t *rig) {
    static const uint16_t COMPARES[] = {R_OCR0A, R_OCR0B, R_OCR1AL, R_OCR1BL, R_OCR2A, R_OCR2B};
    static const uint16_t COUNTS[] = {R_TCNT0, R_TCNT1L, R_TCNT2};
    static const uint16_t CONTROL_B[] = {R_TCCR0B, R_TCCR1B, R_TCCR2B};
    for (int i = 0; i < 6; i++) {
        hook_read(rig, COMPARES[i], on_compare_read);
        hook_write(rig, COMPARES[i], on_compare_write);
    }
    for (int i = 0; i < TIMERS; i++) {
        hook_read(rig, COUNTS[i], on_count_read);
        hook_write(rig, COUNTS[i], on_count_write);
        hook_write(rig, CONTROL_A[i], on_control_a);
        hook_write(rig, CONTROL_B[i], on_control_b);
    }
    hook_write(rig, R_TCCR1C, on_force);
    hook_read(rig, R_TCNT1H, on_temp_read);
    hook_write(rig, R_TCNT1H, on_temp_write);
    hook_read(rig, R_OCR1AH, on_compare_read);
    hook_write(rig, R_OCR1AH, on_temp_write);
    hook_read(rig, R_OCR1BH, on_compare_read);
    hook_write(rig, R_OCR1BH, on_temp_write);
    hook_write(rig, R_GTCCR, on_prescaler);
}
