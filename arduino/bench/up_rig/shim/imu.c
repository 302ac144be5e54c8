/* The MPU6050 at the bus (register map RM-MPU-6000A-00, 4.2) and the ways in which it can fail.
 *
 * Values come from the caller, one sample of seven numbers at a time; a burst sees one sample.
 */
#include <string.h>

#include "rig.h"

enum { SMPLRT_DIV = 25, CONFIG = 26, INT_STATUS = 58, ACCEL_XOUT_H = 59, FIFO_R_W = 116 };
enum { PWR_MGMT_1 = 107, WHO_AM_I = 117 };
enum { IN_RESET = 0x80, ASLEEP = 0x40, DATA_READY = 1 };

static void to_defaults(imu_t *imu) {
    memset(imu->registers, 0, sizeof imu->registers);
    memset(imu->shadow, 0, sizeof imu->shadow);
    imu->registers[PWR_MGMT_1] = ASLEEP;
    imu->sampled = NEVER;
}

void imu_power_on(rig_t *rig, cycle_t now) {
    to_defaults(&rig->imu);
    rig->imu.fault = IMU_OK;
    rig->imu.has_pointer = false;
    /* "Start-up time for register read/write", PS-MPU-6000A-00 6.3; typical. */
    rig->imu.ready = now + 20000 * CYCLES_PER_US;
}

bool imu_holds_sda(const rig_t *rig) {
    const imu_t *imu = &rig->imu;
    return imu->fault == IMU_SDA_LOW ||
           (imu->fault == IMU_RELEASES_AFTER_CLOCKS && imu->clocks_left);
}

bool imu_holds_scl(const rig_t *rig) { return rig->imu.fault == IMU_SCL_LOW; }

/* A slave that hangs in mid-byte releases the bus when the master has clocked the byte out. */
void twi_gpio_clock(rig_t *rig, cycle_t now) {
    imu_t *imu = &rig->imu;
    if (imu->fault != IMU_RELEASES_AFTER_CLOCKS || !imu->clocks_left) return;
    if (--imu->clocks_left == 0) {
        imu->fault = IMU_OK;
        port_update(rig, 1, now);
    }
}

void imu_start(rig_t *rig) {
    imu_t *imu = &rig->imu;
    imu->transfer_bytes = 0;
    imu->transfers++;
    if (imu->fault_transfers) imu->fault_transfers--;
}

/* Counts a byte of the transfer; the planned fault begins with it at its position. */
static void count_byte(rig_t *rig, cycle_t now) {
    imu_t *imu = &rig->imu;
    if (imu->state != IMU_OK && !imu->fault_transfers && imu->transfer_bytes >= imu->fault_after) {
        imu->fault = imu->state;
        imu->state = IMU_OK;
        imu->clocks_left = 9;
        port_update(rig, 1, now);
    }
    imu->transfer_bytes++;
}

static bool is_there(const rig_t *rig, cycle_t now) {
    return rig->imu.is_present && rig->imu.fault == IMU_OK && now >= rig->imu.ready;
}

static cycle_t period(const imu_t *imu) {
    uint8_t filter = imu->registers[CONFIG] & 7;
    cycle_t rate_hz = filter == 0 || filter == 7 ? 8000 : 1000;
    return CYCLES_PER_US * 1000000 / rate_hz * (imu->registers[SMPLRT_DIV] + 1u);
}

/* Takes the newest sample if there is one since the last look. */
static void refresh(rig_t *rig, cycle_t now) {
    imu_t *imu = &rig->imu;
    if (imu->registers[PWR_MGMT_1] & ASLEEP || !imu->sample) return;
    cycle_t newest = now - (now - imu->epoch) % period(imu);
    if (imu->sampled != NEVER && newest <= imu->sampled) return;
    int16_t values[7] = {0};
    imu->sampled = newest;
    imu->samples++;
    imu->sample(newest, values);
    for (int i = 0; i < 7; i++) {
        imu->shadow[2 * i] = (uint8_t)((uint16_t)values[i] >> 8);
        imu->shadow[2 * i + 1] = (uint8_t)values[i];
    }
    imu->registers[INT_STATUS] |= DATA_READY;
}

bool imu_address(rig_t *rig, uint8_t byte, cycle_t now) {
    imu_t *imu = &rig->imu;
    count_byte(rig, now);
    if (!is_there(rig, now) || byte >> 1 != imu->address) return false;
    if (!(byte & 1)) imu->has_pointer = false;
    else refresh(rig, now);
    return true;
}

bool imu_write(rig_t *rig, uint8_t byte, cycle_t now) {
    imu_t *imu = &rig->imu;
    count_byte(rig, now);
    if (!is_there(rig, now)) return false;
    if (!imu->has_pointer) {
        imu->pointer = byte;
        imu->has_pointer = true;
        return true;
    }
    if (imu->pointer == PWR_MGMT_1 && byte & IN_RESET) {
        to_defaults(imu);
    } else if (imu->pointer < WHO_AM_I &&
               !(imu->pointer >= INT_STATUS && imu->pointer < ACCEL_XOUT_H + 14)) {
        imu->registers[imu->pointer] = byte;
        if (imu->pointer == PWR_MGMT_1 || imu->pointer == SMPLRT_DIV) imu->epoch = now;
    }
    imu->pointer = (uint8_t)((imu->pointer + 1) & 127);
    return true;
}

uint8_t imu_read(rig_t *rig, cycle_t now) {
    imu_t *imu = &rig->imu;
    count_byte(rig, now);
    if (!is_there(rig, now)) return 0xFF;
    uint8_t at = imu->pointer & 127;
    if (at != FIFO_R_W) imu->pointer = (uint8_t)((at + 1) & 127);
    if (at >= ACCEL_XOUT_H && at < ACCEL_XOUT_H + 14) return imu->shadow[at - ACCEL_XOUT_H];
    if (at == WHO_AM_I) return imu->identity;
    uint8_t value = imu->registers[at];
    if (at == INT_STATUS) {
        refresh(rig, now);
        value = imu->registers[at];
        imu->registers[at] = 0;
    }
    return value;
}

/* ---- for the caller ---- */
void rig_imu_on_sample(rig_t *rig, imu_sample_t sample) { rig->imu.sample = sample; }
uint8_t rig_imu_register(const rig_t *rig, uint8_t at) { return rig->imu.registers[at & 127]; }
void rig_imu_identity(rig_t *rig, uint8_t identity) { rig->imu.identity = identity; }
uint64_t rig_imu_samples(const rig_t *rig) { return rig->imu.samples; }
uint64_t rig_imu_transfers(const rig_t *rig) { return rig->imu.transfers; }

void rig_imu_plug(rig_t *rig, bool is_present) {
    if (is_present && !rig->imu.is_present) imu_power_on(rig, rig->avr->cycle);
    rig->imu.is_present = is_present;
    if (!is_present) rig->imu.fault = rig->imu.state = IMU_OK;
    port_update(rig, 1, rig->avr->cycle);
    twi_bus_changed(rig, rig->avr->cycle);
}

/* Plans a fault for byte `after` of the transfer after the next `transfers`; kind 0 clears it. */
void rig_imu_fault(rig_t *rig, uint8_t kind, uint32_t after, uint32_t transfers, bool at_once) {
    imu_t *imu = &rig->imu;
    imu->fault = IMU_OK;
    imu->state = kind;
    imu->fault_after = after;
    imu->fault_transfers = transfers;
    if (at_once) {
        imu->fault = kind;
        imu->state = IMU_OK;
        imu->clocks_left = 9;
    }
    port_update(rig, 1, rig->avr->cycle);
    twi_bus_changed(rig, rig->avr->cycle);
}

uint8_t rig_imu_fault_now(const rig_t *rig) { return rig->imu.fault; }
