#include "frame.h"

#include "cobs.h"
#include "crc16.h"

namespace raspilot {

uint8_t write_frame(uint8_t sequence, char type, const uint8_t* payload, uint8_t size,
                    void (*put)(uint8_t at, uint8_t byte)) {
  CobsEncoder cobs(put);
  Crc16 crc;
  const uint8_t check_at = static_cast<uint8_t>(size + 2);
  for (uint8_t index = 0; index < check_at + 2; ++index) {
    uint8_t byte = 0;
    if (index == 0) {
      byte = sequence;
    } else if (index == 1) {
      byte = static_cast<uint8_t>(type);
    } else if (index < check_at) {
      byte = payload[index - 2];
    } else {
      // The second half of the CRC is that of the register before its first half went in.
      byte = crc.high();
    }
    cobs.put(byte);
    crc.put(byte);
  }
  const uint8_t end = cobs.finish();
  put(end, 0);
  return static_cast<uint8_t>(end + 1);
}

}  // namespace raspilot
