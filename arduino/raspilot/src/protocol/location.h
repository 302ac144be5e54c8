/** The ranges of a location, as the bits of IEEE 754 singles. */
#pragma once

#include <stdint.h>

namespace raspilot {

/** 90.0f. */
constexpr uint32_t MAX_LATITUDE = 0x42B40000;
/** 180.0f. */
constexpr uint32_t MAX_LONGITUDE = 0x43340000;

}  // namespace raspilot
