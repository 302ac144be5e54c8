/* The ADC (data sheet 24): one pin's voltage against the internal 1.1 V, single conversions or free
 * running. Interrupts and other references are not modelled: a program that asks for them stops. */
#include "rig.h"

enum { ADEN = 0x80, ADSC = 0x40, ADATE = 0x20, ADIF = 0x10, ADIE = 0x08, PRESCALER = 7 };
enum { REFERENCE_1V1 = 0xC0, REFERENCE_BITS = 0xC0, ADLAR = 0x20, TEMPERATURE_AND_UP = 8 };
enum { CLOCKS = 13, FIRST_CLOCKS = 25, FULL_SCALE_UV = 1100000, COUNTS = 1024 };
enum { FREE_RUNNING = 0, TRIGGER_BITS = 7 };

static cycle_t clock_cycles(const rig_t *rig) {
    uint8_t bits = rig->avr->data[R_ADCSRA] & PRESCALER;
    return bits ? 1u << bits : 2;
}

/* The pin is held 1.5 clocks after the start, 13.5 after the first that switches the ADC on. */
static void start(rig_t *rig, cycle_t at, bool is_first) {
    cycle_t clock = clock_cycles(rig);
    rig->adc.hold = at + clock * (is_first ? 27 : 3) / 2;
    rig->adc.done = at + clock * (is_first ? FIRST_CLOCKS : CLOCKS);
}

static void hold(rig_t *rig) {
    uint8_t choice = rig->avr->data[R_ADMUX];
    if ((choice & REFERENCE_BITS) != REFERENCE_1V1 || (choice & 0x0F) >= TEMPERATURE_AND_UP)
        note_crash(rig, "not_modelled", "the rig's ADC does not model ADMUX 0x%02x", choice);
    uint64_t count = (uint64_t)rig->adc.pins_uv[choice & 7] * COUNTS / FULL_SCALE_UV;
    rig->adc.held = count < COUNTS ? (uint16_t)count : COUNTS - 1;
    rig->adc.hold = NEVER;
}

/* Everything up to a cycle: nothing outside depends on the ADC, so it may be done late. */
static void advance(rig_t *rig, cycle_t now) {
    uint8_t *data = rig->avr->data;
    for (;;) {
        if (rig->adc.hold <= now) hold(rig);
        if (rig->adc.done > now) return;
        uint16_t result = data[R_ADMUX] & ADLAR ? (uint16_t)(rig->adc.held << 6) : rig->adc.held;
        if (!rig->adc.is_locked) {
            data[R_ADCL] = (uint8_t)result;
            data[R_ADCH] = (uint8_t)(result >> 8);
        }
        data[R_ADCSRA] |= ADIF;
        if (data[R_ADCSRA] & ADATE) {
            start(rig, rig->adc.done, false);
        } else {
            data[R_ADCSRA] &= (uint8_t)~ADSC;
            rig->adc.done = NEVER;
        }
    }
}

static void on_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    cycle_t now = write_time(rig);
    advance(rig, now);
    uint8_t old = avr->data[address];
    if (value & ADIE || (value & ADATE && (avr->data[R_ADCSRB] & TRIGGER_BITS) != FREE_RUNNING))
        note_crash(rig, "not_modelled", "the rig's ADC does not model ADCSRA 0x%02x", value);
    bool was_running = old & ADEN && old & ADSC;
    avr->data[address] = (uint8_t)((value & ~ADIF) | (old & ADIF & ~value));
    if (!(value & ADEN)) {
        avr->data[address] &= (uint8_t)~ADSC;
        rig->adc.hold = rig->adc.done = NEVER;
    } else if (was_running) {
        avr->data[address] |= ADSC;
    } else if (value & ADSC) {
        start(rig, now, !(old & ADEN));
    }
}

/* ADCL locks the result until ADCH is read (24.9.3). */
static uint8_t on_read(avr_t *avr, avr_io_addr_t address, void *param) {
    rig_t *rig = param;
    advance(rig, read_time(rig));
    if (address != R_ADCSRA) rig->adc.is_locked = address == R_ADCL;
    return avr->data[address];
}

void adc_reset(rig_t *rig) {
    rig->adc.hold = rig->adc.done = NEVER;
    rig->adc.is_locked = false;
}

void adc_hook(rig_t *rig) {
    adc_reset(rig);
    hook_write(rig, R_ADCSRA, on_control);
    hook_read(rig, R_ADCSRA, on_read);
    hook_read(rig, R_ADCL, on_read);
    hook_read(rig, R_ADCH, on_read);
}

/* The voltage of pin A0 to A7 from now on. */
void rig_analog(rig_t *rig, uint8_t pin, uint32_t microvolts) {
    advance(rig, rig->avr->cycle);
    rig->adc.pins_uv[pin & 7] = microvolts;
}
