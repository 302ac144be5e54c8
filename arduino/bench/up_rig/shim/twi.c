/* The two-wire interface as master (data sheet 22), at the rate of TWBR and bit by bit exact.
 *
 * simavr takes 1 us for a bit at any TWBR and answers an address with the codes of data.
 * Here the slave may hold the bus: a start then waits without end, a byte whose clock is held
 * never ends, and neither sets TWINT. A data line held while the master sends a one is a lost
 * arbitration (0x38), as the chip cannot distinguish it from another master.
 */
#include "rig.h"

enum { TWINT = 0x80, TWEA = 0x40, TWSTA = 0x20, TWSTO = 0x10, TWWC = 0x08, TWEN = 0x04 };
enum { START = 0x08, REPEATED_START = 0x10, LOST = 0x38, NOTHING = 0xF8 };

static uint8_t *control(rig_t *rig) { return &rig->avr->data[R_TWCR]; }

static cycle_t bit_cycles(const rig_t *rig) {
    const uint8_t *data = rig->avr->data;
    return 16 + 2 * ((cycle_t)data[R_TWBR] << 2 * (data[R_TWSR] & 3));
}

bool twi_has_pins(const rig_t *rig) { return rig->avr->data[R_TWCR] & TWEN; }

static bool is_held(const rig_t *rig) { return imu_holds_sda(rig) || imu_holds_scl(rig); }

static void plan(rig_t *rig, cycle_t due) {
    rig->twi.due = due;
    rig->is_planned = false;
}

static void begin(rig_t *rig, int doing, cycle_t due) {
    rig->twi.doing = doing;
    rig->twi.is_waiting = false;
    plan(rig, due);
}

static void finish(rig_t *rig, uint8_t status) {
    uint8_t *data = rig->avr->data;
    rig->twi.doing = DO_NOTHING;
    data[R_TWSR] = (uint8_t)((data[R_TWSR] & 3) | status);
    set_flag(rig, R_TWCR, TWINT);
    port_update(rig, 1, rig->twi.due);
    plan(rig, NEVER);
}

static void lose(rig_t *rig) {
    rig->twi.state = TWI_FOREIGN;
    finish(rig, LOST);
}

/* The bus is held: what is being done goes on when it is released. */
static void wait_for_bus(rig_t *rig) {
    rig->twi.is_waiting = true;
    plan(rig, NEVER);
}

static void start(rig_t *rig, cycle_t now) {
    cycle_t free_at = rig->twi.free_at;
    begin(rig, DO_START, (free_at > now ? free_at : now) + bit_cycles(rig));
    if (is_held(rig)) wait_for_bus(rig);
}

static void stop(rig_t *rig, cycle_t now) {
    begin(rig, DO_STOP, now + bit_cycles(rig));
    if (is_held(rig)) wait_for_bus(rig);
}

static void byte(rig_t *rig, cycle_t now) {
    twi_t *twi = &rig->twi;
    int doing = twi->state == TWI_STARTED ? DO_ADDRESS : twi->state == TWI_READING ? DO_READ
                                                                                  : DO_WRITE;
    twi->byte = rig->avr->data[R_TWDR];
    begin(rig, doing, now + 9 * bit_cycles(rig));
    if (imu_holds_scl(rig)) wait_for_bus(rig);
}

/* The bus is released, or held: a waiting transfer resumes, a running one may stop. */
void twi_bus_changed(rig_t *rig, cycle_t now) {
    twi_t *twi = &rig->twi;
    if (!twi->is_waiting || !twi_has_pins(rig)) return;
    if (twi->doing == DO_START && !is_held(rig)) start(rig, now);
    else if (twi->doing == DO_STOP && !is_held(rig)) stop(rig, now);
    else if (twi->doing >= DO_ADDRESS && twi->doing <= DO_READ && !imu_holds_scl(rig))
        begin(rig, twi->doing, now + 9 * bit_cycles(rig));
}

/* Whether a one could not be sent, as the data line is held. */
static bool is_one_lost(const rig_t *rig, uint8_t value) {
    return imu_holds_sda(rig) && value != 0;
}

static void end_address(rig_t *rig) {
    twi_t *twi = &rig->twi;
    bool is_read = twi->byte & 1;
    bool is_acknowledged = imu_address(rig, twi->byte, twi->due);
    if (imu_holds_scl(rig)) return wait_for_bus(rig);
    if (is_one_lost(rig, twi->byte)) return lose(rig);
    if (imu_holds_sda(rig)) is_acknowledged = true;
    twi->state = is_read ? TWI_READING : TWI_WRITING;
    finish(rig, (uint8_t)((is_read ? 0x40 : 0x18) + (is_acknowledged ? 0 : 8)));
}

static void end_write(rig_t *rig) {
    twi_t *twi = &rig->twi;
    bool is_acknowledged = imu_write(rig, twi->byte, twi->due);
    if (imu_holds_scl(rig)) return wait_for_bus(rig);
    if (is_one_lost(rig, twi->byte)) return lose(rig);
    finish(rig, imu_holds_sda(rig) || is_acknowledged ? 0x28 : 0x30);
}

static void end_read(rig_t *rig) {
    twi_t *twi = &rig->twi;
    bool is_last = !(*control(rig) & TWEA);
    uint8_t value = imu_read(rig, twi->due);
    if (imu_holds_scl(rig)) return wait_for_bus(rig);
    if (imu_holds_sda(rig)) value = 0;
    rig->avr->data[R_TWDR] = value;
    if (imu_holds_sda(rig) && is_last) return lose(rig);
    finish(rig, is_last ? 0x58 : 0x50);
}

void twi_run(rig_t *rig, cycle_t now) {
    twi_t *twi = &rig->twi;
    if (twi->due > now) return;
    switch (twi->doing) {
        case DO_START:
            *control(rig) &= (uint8_t)~TWWC;
            bool is_repeated = twi->state == TWI_READING || twi->state == TWI_WRITING ||
                               twi->state == TWI_STARTED;
            twi->state = TWI_STARTED;
            imu_start(rig);
            finish(rig, is_repeated ? REPEATED_START : START);
            break;
        case DO_ADDRESS: end_address(rig); break;
        case DO_WRITE: end_write(rig); break;
        case DO_READ: end_read(rig); break;
        case DO_STOP: {
            cycle_t when = twi->due;
            uint8_t *data = rig->avr->data;
            *control(rig) &= (uint8_t)~TWSTO;
            data[R_TWSR] = (uint8_t)((data[R_TWSR] & 3) | NOTHING);
            twi->state = TWI_IDLE;
            twi->doing = DO_NOTHING;
            twi->free_at = when + bit_cycles(rig) / 2;
            plan(rig, NEVER);
            if (*control(rig) & TWSTA) start(rig, when);
            break;
        }
        default: plan(rig, NEVER);
    }
}

static void on_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    twi_t *twi = &rig->twi;
    (void)address;
    cycle_t now = write_time(rig);
    run_events(rig, now);
    uint8_t old = avr->data[R_TWCR];
    bool is_new = !(old & TWEN);
    /* Writing one to TWINT clears it and starts the other bits' action; TWSTO clears itself. */
    uint8_t kept = value & TWINT ? 0 : old & TWINT;
    avr->data[R_TWCR] = (uint8_t)((value & 0x75) | kept | (old & TWSTO) | (old & TWWC));
    if (!(value & TWEN)) {
        avr->data[R_TWCR] = value & 0x41;
        twi->state = TWI_IDLE;
        begin(rig, DO_NOTHING, NEVER);
    } else if (twi->doing == DO_NOTHING && (value & TWINT || !(old & TWINT))) {
        if (value & TWSTO && twi->state == TWI_FOREIGN) {
            /* No stop is sent on another master's bus; the lines are just released (22.7.5). */
            avr->data[R_TWCR] &= (uint8_t)~TWSTO;
            twi->state = TWI_IDLE;
            if (value & TWSTA) start(rig, now);
        } else if (value & TWSTO) {
            stop(rig, now);
        } else if (value & TWSTA) {
            start(rig, now);
        } else if (value & TWINT && old & TWINT &&
                   (twi->state == TWI_STARTED || twi->state == TWI_WRITING ||
                    twi->state == TWI_READING)) {
            byte(rig, now);
        } else if (value & TWINT && twi->state == TWI_FOREIGN) {
            twi->state = TWI_IDLE;
        }
    }
    if (is_new || !(value & TWEN)) port_update(rig, 1, now);
    interrupts_refresh(rig);
}

static void on_data(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    run_events(rig, write_time(rig));
    if (avr->data[R_TWCR] & TWINT) {
        avr->data[address] = value;
        avr->data[R_TWCR] &= (uint8_t)~TWWC;
    } else {
        avr->data[R_TWCR] |= TWWC;
    }
}

static void on_status(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    (void)param;
    avr->data[address] = (uint8_t)((avr->data[address] & 0xF8) | (value & 3));
}

void twi_reset(rig_t *rig) {
    rig->twi.state = TWI_IDLE;
    rig->twi.doing = DO_NOTHING;
    rig->twi.is_waiting = false;
    rig->twi.due = NEVER;
    rig->avr->data[R_TWSR] = NOTHING;
    rig->avr->data[R_TWDR] = 0xFF;
    rig->avr->data[R_TWAR] = 0xFE;
}

void twi_hook(rig_t *rig) {
    hook_write(rig, R_TWCR, on_control);
    hook_read(rig, R_TWCR, read_register);
    hook_write(rig, R_TWDR, on_data);
    hook_read(rig, R_TWDR, read_register);
    hook_write(rig, R_TWSR, on_status);
    hook_read(rig, R_TWSR, read_register);
}
