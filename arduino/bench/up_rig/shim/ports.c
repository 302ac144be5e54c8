/* Pins (data sheet 14, 13.2): their drivers, their levels, the servos' view. */
#include "rig.h"

/* A level passes the synchronizer before PIN shows it, and some cycles more until its change sets
 * the flag of the pin change interrupt (13.1.1, figure 13-1). */
enum { SYNCHRONIZER = 1, CHANGE_TO_FLAG = 3 };
enum { PORT_C = 1, SDA = 4, SCL = 5 };

static const uint16_t MASKS[PORTS] = {R_PCMSK0, R_PCMSK1, R_PCMSK2};

static uint16_t port_register(uint8_t port) { return (uint16_t)(R_PORTB + 3 * port); }
static uint16_t direction_register(uint8_t port) { return (uint16_t)(R_DDRB + 3 * port); }
static uint8_t port_of(avr_io_addr_t address) { return (uint8_t)((address - R_PINB) / 3); }

static void note_edge(rig_t *rig, cycle_t now, uint8_t pin, uint8_t level) {
    edge_t edge = {now, pin, level};
    if (!rig->drops_edges) record_add(&rig->edges, &edge, sizeof edge);
    if (level) rig->rises[pin] = now;
    else rig->pulses[pin] = (pulse_t){rig->rises[pin], now};
}

void port_update(rig_t *rig, uint8_t number, cycle_t now) {
    port_t *port = &rig->ports[number];
    uint8_t out = rig->avr->data[port_register(number)];
    uint8_t direction = rig->avr->data[direction_register(number)];
    uint8_t pull_up = rig->avr->data[R_MCUCR] & 0x10 ? 0 : out;
    uint8_t outside = (uint8_t)((port->drive & port->driven) | (pull_up & ~port->driven));
    out = (uint8_t)((out & ~port->override) | (port->latch & port->override));
    uint8_t level = (uint8_t)((out & direction) | (outside & ~direction));
    if (number == PORT_C) {
        /* Both lines of the bus are pulled up on the IMU's board, and any device may hold them. */
        bool has_pins = twi_has_pins(rig);
        uint8_t bus = 1 << SDA | 1 << SCL;
        uint8_t held = (uint8_t)(has_pins ? 0 : direction & ~out);
        if (imu_holds_sda(rig)) held |= 1 << SDA;
        if (imu_holds_scl(rig)) held |= 1 << SCL;
        if (rig->imu.is_present || has_pins || !(direction & bus))
            level = (uint8_t)((level & ~bus) | (bus & ~held));
    }
    uint8_t changed = level ^ port->level;
    uint8_t line = direction & out;
    uint8_t moved = line ^ port->line;
    bool was_clock_low = number == PORT_C && changed & level & 1 << SCL;
    port->level = level;
    port->line = line;
    for (uint8_t bit = 0; moved; bit++, moved >>= 1)
        if (moved & 1) note_edge(rig, now, (uint8_t)(number * 8 + bit), line >> bit & 1);
    if (changed & rig->avr->data[MASKS[number]])
        queue_add(&rig->queue, now + CHANGE_TO_FLAG, EVENT_PIN_FLAG, number, 0);
    if (was_clock_low && !twi_has_pins(rig)) twi_gpio_clock(rig, now);
    rig->is_planned = false;
}

void port_drive(rig_t *rig, uint8_t pin, uint8_t how, cycle_t now) {
    port_t *port = &rig->ports[pin / 8];
    uint8_t bit = (uint8_t)(1 << pin % 8);
    port->driven = how == 2 ? port->driven & ~bit : port->driven | bit;
    port->drive = how == 1 ? port->drive | bit : port->drive & ~bit;
    port_update(rig, pin / 8, now);
}

void port_take(rig_t *rig, uint8_t pin, bool is_taken, bool latch, cycle_t now) {
    port_t *port = &rig->ports[pin / 8];
    uint8_t bit = (uint8_t)(1 << pin % 8);
    port->override = is_taken ? port->override | bit : port->override & ~bit;
    port->latch = latch ? port->latch | bit : port->latch & ~bit;
    port_update(rig, pin / 8, now);
}

void pin_flag(rig_t *rig, uint8_t port) { set_flag(rig, R_PCIFR, (uint8_t)(1 << port)); }

void ports_reset(rig_t *rig, cycle_t now) {
    for (uint8_t number = 0; number < PORTS; number++) {
        rig->ports[number].override = 0;
        port_update(rig, number, now);
    }
}

static uint8_t on_pin_read(avr_t *avr, avr_io_addr_t address, void *param) {
    rig_t *rig = param;
    (void)avr;
    /* A change in the last cycle is not through the synchronizer yet. */
    run_events(rig, read_time(rig) - SYNCHRONIZER);
    return rig->ports[port_of(address)].level;
}

static void on_write(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    uint8_t port = port_of(address);
    if (address == R_PINB + 3 * port)
        avr->data[port_register(port)] ^= bits_written(rig, value);
    else
        avr->data[address] = value;
    port_update(rig, port, write_time(rig));
}

static void on_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    avr->data[address] = value;
    for (uint8_t port = 0; port < PORTS; port++) port_update(rig, port, write_time(rig));
}

void ports_hook(rig_t *rig) {
    for (uint8_t port = 0; port < PORTS; port++) {
        uint16_t base = (uint16_t)(R_PINB + 3 * port);
        hook_read(rig, base, on_pin_read);
        for (uint8_t i = 0; i < 3; i++) hook_write(rig, (uint16_t)(base + i), on_write);
    }
    hook_write(rig, R_MCUCR, on_control);
}
