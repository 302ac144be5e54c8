/* The EEPROM (data sheet 8.4, 8.6): a write takes 3.4 ms, in which power may be cut. */
#include <string.h>

#include "rig.h"

enum { EERE = 1, EEPE = 2, EEMPE = 4, EERIE = 8, EEPM = 0x30 };
enum { ERASE_AND_WRITE, ERASE, WRITE };
enum { BOTH_US = 3400, HALF_US = 1800 };

static void finish(rig_t *rig) {
    eeprom_t *eeprom = &rig->eeprom;
    uint8_t *cell = &eeprom->cells[eeprom->address];
    uint8_t erased = eeprom->mode == WRITE ? *cell : 0xFF;
    *cell = eeprom->mode == ERASE ? 0xFF : erased & eeprom->value;
    eeprom->done = NEVER;
    eeprom->writes++;
    rig->avr->data[R_EECR] &= (uint8_t)~EEPE;
    interrupts_refresh(rig);
    rig->is_planned = false;
}

void eeprom_run(rig_t *rig, cycle_t now) {
    if (rig->eeprom.done <= now) finish(rig);
}

/* Result of a write cut by a power failure: some bits changed, others did not. */
void eeprom_power_cut(rig_t *rig, cycle_t now) {
    eeprom_t *eeprom = &rig->eeprom;
    if (eeprom->done == NEVER) return;
    uint8_t *cell = &eeprom->cells[eeprom->address];
    bool is_erasing = eeprom->mode == ERASE ||
                      (eeprom->mode == ERASE_AND_WRITE &&
                       eeprom->done - now > (BOTH_US - HALF_US) * CYCLES_PER_US);
    uint8_t some = (uint8_t)next_random(rig);
    uint8_t erased = eeprom->mode == WRITE ? *cell : 0xFF;
    *cell = is_erasing ? *cell | some : erased & (eeprom->value | some);
    eeprom->done = NEVER;
}

static void on_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    rig_t *rig = param;
    eeprom_t *eeprom = &rig->eeprom;
    cycle_t now = write_time(rig);
    run_events(rig, now);
    uint8_t old = avr->data[address];
    bool may_write = now <= eeprom->master_until;
    bool is_busy = old & EEPE;
    uint8_t written = bits_written(rig, value);
    if (written & EEMPE) eeprom->master_until = now + 4;
    avr->data[address] = (uint8_t)((value & (is_busy ? EERIE : EERIE | EEPM)) |
                                   (is_busy ? old & (EEPM | EEPE) : 0));
    uint16_t at = (uint16_t)(avr->data[R_EEARL] | (avr->data[R_EEARH] & 3) << 8);
    if (written & EEPE && may_write && !is_busy) {
        eeprom->address = at;
        eeprom->value = avr->data[R_EEDR];
        eeprom->mode = value >> 4 & 3;
        unsigned length_us = eeprom->mode == ERASE_AND_WRITE ? BOTH_US : HALF_US;
        eeprom->done = now + length_us * CYCLES_PER_US;
        eeprom->master_until = 0;
        avr->data[address] |= EEPE;
        avr->cycle += 2; /* the CPU is halted (8.6.3) */
        rig->is_planned = false;
    } else if (written & EERE && !is_busy) {
        avr->data[R_EEDR] = eeprom->cells[at];
        avr->cycle += 4;
    }
    interrupts_refresh(rig);
}

static uint8_t on_read(avr_t *avr, avr_io_addr_t address, void *param) {
    rig_t *rig = param;
    run_events(rig, read_time(rig));
    return avr->data[address] | (read_time(rig) <= rig->eeprom.master_until ? EEMPE : 0);
}

/* A reset does not stop a write that has begun (8.4.2). */
void eeprom_reset(rig_t *rig) {
    rig->eeprom.master_until = 0;
    if (rig->eeprom.done != NEVER) rig->avr->data[R_EECR] = EEPE;
}

void eeprom_hook(rig_t *rig) {
    memset(rig->eeprom.cells, 0xFF, sizeof rig->eeprom.cells);
    rig->eeprom.done = NEVER;
    hook_read(rig, R_EECR, on_read);
    hook_write(rig, R_EECR, on_control);
}

uint8_t *rig_eeprom(rig_t *rig) { return rig->eeprom.cells; }
uint64_t rig_eeprom_writes(const rig_t *rig) { return rig->eeprom.writes; }
bool rig_eeprom_is_writing(const rig_t *rig) { return rig->eeprom.done != NEVER; }
