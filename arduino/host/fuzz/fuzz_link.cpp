/** The entry of libFuzzer: see link_script.h. */
#include "link_script.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* script, size_t size) {
  raspilot::play(script, size);
  return 0;
}
