/* The caller's queries to a rig, beside running it; those of each part are in its file. */
#include <string.h>

#include "rig.h"

uint64_t rig_cycle(const rig_t *rig) { return rig->avr->cycle; }
uint8_t *rig_data(rig_t *rig) { return rig->avr->data; }
const meter_t *rig_meter(const rig_t *rig) { return &rig->meter; }
const char *rig_crash_code(const rig_t *rig) { return rig->crash_code; }
uint64_t rig_overruns(const rig_t *rig) { return rig->uart.overruns; }
void rig_start_up(rig_t *rig, uint64_t cycles) { rig->start_up = cycles ? cycles : 1; }

void rig_load(rig_t *rig, const uint8_t *bytes, uint32_t size, uint32_t address) {
    memcpy(rig->avr->flash + address, bytes, size);
    quick_discard(rig);
}

void rig_measure(rig_t *rig, bool is_measuring) { rig->is_measuring = is_measuring; }

void rig_reset_pc(rig_t *rig, uint32_t address) { rig->avr->reset_pc = address; }

void rig_preload(rig_t *rig, uint32_t break_pc, uint16_t address, const uint8_t *bytes,
                 uint16_t size) {
    if (rig->preload_count == 16 || size > 64) return;
    rig->preloads[rig->preload_count].address = address;
    rig->preloads[rig->preload_count].size = size;
    memcpy(rig->preloads[rig->preload_count++].bytes, bytes, size);
    rig->break_pc = break_pc;
}

void rig_clear_measures(rig_t *rig) {
    uint64_t resets[4];
    memcpy(resets, rig->meter.resets, sizeof resets);
    memset(&rig->meter, 0, sizeof rig->meter);
    memcpy(rig->meter.resets, resets, sizeof resets);
    rig->meter.stack_lowest = (uint16_t)rig->avr->ramend;
    if (!rig->avr->sreg[S_I] && rig->off_since != NEVER) rig->off_since = rig->avr->cycle;
    rig->entered = rig->avr->cycle;
}

void rig_reset(rig_t *rig, uint8_t cause) {
    if (cause & (RESET_POWER | RESET_BROWN_OUT)) {
        eeprom_power_cut(rig, rig->avr->cycle);
        imu_power_on(rig, rig->avr->cycle);
    }
    want_reset(rig, cause);
}

void rig_pin_edge(rig_t *rig, uint64_t cycle, uint8_t pin, uint8_t how) {
    queue_add(&rig->queue, cycle > rig->avr->cycle ? cycle : rig->avr->cycle, EVENT_PIN, pin, how);
    rig->is_planned = false;
}

uint8_t rig_pin_level(const rig_t *rig, uint8_t pin) {
    return rig->ports[pin / 8].level >> pin % 8 & 1;
}

/* The records since the last clearing; the pointer holds until the chip runs on. */
const edge_t *rig_edges(const rig_t *rig, uint64_t *count) {
    *count = rig->edges.count;
    return rig->edges.items;
}

const sent_t *rig_sent(const rig_t *rig, uint64_t *count) {
    *count = rig->sent.count;
    return rig->sent.items;
}

/* The newest whole pulse of each pin; the pointer holds as long as the rig. */
const pulse_t *rig_pulses(const rig_t *rig) { return rig->pulses; }
void rig_drop_edges(rig_t *rig, bool is_dropping) { rig->drops_edges = is_dropping; }
void rig_clear_edges(rig_t *rig) { rig->edges.count = 0; }
void rig_clear_sent(rig_t *rig) { rig->sent.count = 0; }
