/** From the demands on the aircraft to servo pulses: mix, direction, trim, end points. */
#pragma once

#include "../core/types.h"
#include "../store/profile.h"

namespace raspilot {

/**
 * Turns demands (ticks, 1500 us is neutral, 2000 us rolls right, raises the nose, yaws right) into
 * servo pulses. Elevon: the left surface (ailerons' output) gets elevator - ailerons, the right one
 * (elevator's output) elevator + ailerons: both rise with the nose, the right one with a roll to
 * the right. V-tail: elevator + rudder and elevator - rudder on the elevator's and the rudder's
 * output. Directions of servos are the profile's. A motor's throttle is neither reversed nor
 * trimmed, and its 1000 us pass whatever the end points say: they mean off.
 */
void to_servos(const Profile& profile, const Ticks* demands, Outputs& outputs);

}  // namespace raspilot
