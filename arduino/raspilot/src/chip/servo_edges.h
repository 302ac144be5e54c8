/**
 * The next edge of each servo output, made by a timer (data sheet 16.7, 18.5).
 *
 * Ailerons and elevator are OC1A and OC1B: the compare register holds the edge's time. Throttle
 * and rudder are OC2B and OC2A of the eight bit Timer2, whose matches recur each 128 us: the pin
 * is set to change only in the last of these rounds, and the edge is as exact as the others.
 */
#pragma once

#include <stdint.h>

#include "../core/types.h"

namespace raspilot {
namespace servo_edges {

/** Makes the pins outputs, low. After clock::begin(). */
void begin();

/** Whether a pulse is planned or under way. */
bool is_busy(Channel channel);

/**
 * Plans a pulse that rises at a time of Timer1, at least 200 us and at most 16 ms from now, on an
 * output that is not busy. Its width is the one that is set when it rises.
 */
void plan(Channel channel, uint16_t rise_ticks);

/** The width of the pulses that rise from now on, ticks. */
void set_width(Channel channel, Ticks width);

}  // namespace servo_edges
}  // namespace raspilot
