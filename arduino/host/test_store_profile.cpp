#include <doctest/doctest.h>
#include <string.h>

#include "store/profile.h"
#include "wire_vectors.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

Bytes wire_of(const Profile& profile) {
  Bytes wire(PROFILE_SIZE);
  write_profile(profile, wire.data());
  return wire;
}

Bytes put_u16(Bytes wire, size_t at, int value) {
  wire[at] = static_cast<uint8_t>(value >> 8);
  wire[at + 1] = static_cast<uint8_t>(value);
  return wire;
}

Bytes put_u8(Bytes wire, size_t at, int value) {
  wire[at] = static_cast<uint8_t>(value);
  return wire;
}

bool is_taken(const Bytes& wire) {
  Profile profile = DEFAULT_PROFILE;
  const bool is_right = read_profile(wire.data(), profile);
  CHECK(wire_of(profile) == (is_right ? wire : wire_of(DEFAULT_PROFILE)));
  return is_right;
}

void check_word(size_t at, int least, int most) {
  CAPTURE(at);
  const Bytes wire = wire_of(DEFAULT_PROFILE);
  CHECK(is_taken(put_u16(wire, at, least)));
  CHECK(is_taken(put_u16(wire, at, most)));
  CHECK_FALSE(is_taken(put_u16(wire, at, least - 1)));
  CHECK_FALSE(is_taken(put_u16(wire, at, most + 1)));
  CHECK_FALSE(is_taken(put_u16(wire, at, -32768)));
}

}  // namespace

TEST_CASE("the default profile is that of the page") {
  const Bytes channel = bytes_of("00000003e807d0");
  Bytes wire;
  for (int output = 0; output < 4; ++output) wire.insert(wire.end(), channel.begin(), channel.end());
  const Bytes rest = bytes_of("0001616641138807d009c4fed407d003e8038405dc05dc05dc00");
  wire.insert(wire.end(), rest.begin(), rest.end());
  CHECK(wire_of(DEFAULT_PROFILE) == wire);
}

TEST_CASE("the golden profiles are read and written back as they are") {
  const auto payloads = payloads_of("C");
  REQUIRE(payloads.size() >= 2);
  for (const Bytes& wire : payloads) CHECK(is_taken(wire));
}

TEST_CASE("each field of a profile lands in its place") {
  Profile profile = DEFAULT_PROFILE;
  const Bytes wire = bytes_of(
      "00ff38032008980100c8044c076c00000003e807d0010001038404b0"
      "0200416172000127102328dcd8dcd90321038408980321032201");
  REQUIRE(wire.size() == PROFILE_SIZE);
  // 10000 cdeg is not a limit: the rest of this wire is right.
  REQUIRE_FALSE(read_profile(wire.data(), profile));
  REQUIRE(read_profile(put_u16(wire, 35, 9000).data(), profile));
  CHECK_FALSE(profile.servos[AILERONS].is_reversed);
  CHECK(profile.servos[AILERONS].trim_us == -200);
  CHECK(profile.servos[AILERONS].lowest_us == 800);
  CHECK(profile.servos[AILERONS].highest_us == 2200);
  CHECK(profile.servos[ELEVATOR].is_reversed);
  CHECK(profile.servos[ELEVATOR].trim_us == 200);
  CHECK(profile.servos[ELEVATOR].lowest_us == 1100);
  CHECK(profile.servos[ELEVATOR].highest_us == 1900);
  CHECK_FALSE(profile.servos[THROTTLE].is_reversed);
  CHECK(profile.servos[RUDDER].is_reversed);
  CHECK(profile.servos[RUDDER].trim_us == 1);
  CHECK(profile.servos[RUDDER].lowest_us == 900);
  CHECK(profile.servos[RUDDER].highest_us == 1200);
  CHECK(profile.mix == Mix::V_TAIL);
  CHECK_FALSE(profile.has_motor);
  CHECK(std::string(profile.switch_modes, 3) == "Aar");
  CHECK(profile.roll_limit_cdeg == 1);
  CHECK(profile.pitch_up_limit_cdeg == 9000);
  CHECK(profile.pitch_down_limit_cdeg == 9000);
  CHECK(profile.glide_pitch_cdeg == -9000);
  CHECK(profile.circle_bank_cdeg == -8999);
  CHECK(profile.throttle_failsafe_us == 801);
  CHECK(profile.throttle_lost_us == 900);
  CHECK(profile.preset_ailerons_us == 2200);
  CHECK(profile.preset_elevator_us == 801);
  CHECK(profile.preset_rudder_us == 802);
  CHECK(profile.may_return_with_motor());
  CHECK_FALSE(profile.may_pi_fly());
  CHECK(profile.throttle_slew() == 0);
}

TEST_CASE("a profile with one value out of range is refused whole") {
  const Bytes wire = wire_of(DEFAULT_PROFILE);
  for (size_t servo = 0; servo < OUTPUTS * 7; servo += 7) {
    CAPTURE(servo);
    CHECK(is_taken(put_u8(wire, servo, 1)));
    CHECK_FALSE(is_taken(put_u8(wire, servo, 2)));
    check_word(servo + 1, -200, 200);
    check_word(servo + 3, 800, 1999);
    check_word(servo + 5, 1001, 2200);
  }
  CHECK(is_taken(put_u8(wire, 28, 2)));
  CHECK_FALSE(is_taken(put_u8(wire, 28, 3)));
  CHECK(is_taken(put_u8(wire, 29, 0)));
  CHECK_FALSE(is_taken(put_u8(wire, 29, 2)));
  for (size_t limit = 33; limit <= 37; limit += 2) check_word(limit, 0, 9000);
  for (size_t angle = 39; angle <= 41; angle += 2) check_word(angle, -9000, 9000);
  check_word(43, 800, 2200);
  check_word(45, 0, 2200);
  for (size_t preset = 47; preset <= 51; preset += 2) check_word(preset, 800, 2200);
}

TEST_CASE("the last byte of a profile has two bits, and the throttle's slew limit above them") {
  Profile profile = DEFAULT_PROFILE;
  CHECK(profile.flags == 0);
  CHECK(read_profile(put_u8(wire_of(DEFAULT_PROFILE), 53, 63 * 4 + 2).data(), profile));
  CHECK_FALSE(profile.may_return_with_motor());
  CHECK(profile.may_pi_fly());
  CHECK(profile.throttle_slew() == 63);
}

TEST_CASE("the switch selects ACRO, RATE, FBW and AUTO, and nothing else") {
  const Bytes wire = wire_of(DEFAULT_PROFILE);
  for (size_t position = 30; position < 33; ++position) {
    for (int letter = 0; letter < 256; ++letter) {
      const bool is_mode = letter == 'a' || letter == 'r' || letter == 'f' || letter == 'A';
      CHECK(is_taken(put_u8(wire, position, letter)) == is_mode);
    }
  }
}
