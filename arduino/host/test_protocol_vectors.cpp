#include <doctest/doctest.h>

#include <algorithm>

#include "protocol/checked_reader.h"
#include "protocol/cobs.h"
#include "protocol/command_executor.h"
#include "protocol/crc16.h"
#include "frame_bytes.h"
#include "wire_vectors.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

Bytes frame_of(uint8_t sequence, char type, const Bytes& payload) {
  return frame_bytes(sequence, type, payload.data(), static_cast<uint8_t>(payload.size()));
}

struct Reading {
  CheckedReader reader;
  unsigned frames = 0;
  unsigned broken = 0;

  void take(const Bytes& bytes, uint32_t now_us = 0) {
    for (uint8_t byte : bytes) {
      const CheckedReader::Found found = reader.receive(byte, now_us);
      frames += found == CheckedReader::Found::FRAME;
      broken += found == CheckedReader::Found::BROKEN;
    }
  }
};

extern "C" const CommandDefinition __start_raspilot_commands[];
extern "C" const CommandDefinition __stop_raspilot_commands[];

int registered(char type) {
  return static_cast<int>(
      std::count_if(__start_raspilot_commands, __stop_raspilot_commands,
                    [type](const CommandDefinition& each) { return each.type == type; }));
}

}  // namespace

TEST_CASE("the CRC is that of the golden vectors") {
  for (const auto& vector : vectors_of("crc16")) {
    Crc16 crc;
    for (uint8_t byte : bytes_of(vector.at("bytes"))) crc.put(byte);
    const Bytes expected = bytes_of(vector.at("crc"));
    CHECK(crc.high() == expected[0]);
    CHECK(crc.low() == expected[1]);
    crc.put(expected[0]);
    crc.put(expected[1]);
    CHECK(crc.is_zero());
  }
}

TEST_CASE("COBS is that of the golden vectors, as long as frames are short") {
  unsigned short_ones = 0;
  for (const auto& vector : vectors_of("cobs")) {
    const Bytes plain = bytes_of(vector.at("plain"));
    const Bytes encoded = bytes_of(vector.at("encoded"));
    if (plain.size() > MAX_FRAME) continue;
    ++short_ones;
    CobsEncoder<put_written> encoder;
    encoder.begin();
    for (uint8_t byte : plain) encoder.put(byte);
    CHECK(Bytes(written_frame(), written_frame() + encoder.finish()) == encoded);
    CobsDecoder decoder;
    Bytes decoded;
    for (uint8_t byte : encoded) {
      uint8_t one;
      if (decoder.receive(byte, one) == CobsDecoder::Step::BYTE) decoded.push_back(one);
    }
    CHECK(decoder.is_complete());
    CHECK(decoded == plain);
  }
  CHECK(short_ones > 3);
}

TEST_CASE("every golden frame is written byte for byte and read back") {
  for (const auto& vector : vectors_of("serial_checked")) {
    const Bytes wire = bytes_of(vector.at("wire"));
    const Bytes payload = bytes_of(vector.at("payload"));
    const char type = vector.at("type")[0];
    const uint8_t sequence = static_cast<uint8_t>(std::stoi(vector.at("sequence")));
    CHECK(frame_of(sequence, type, payload) == wire);
    Reading reading;
    reading.take(wire);
    REQUIRE(reading.frames == 1);
    CHECK(reading.reader.type() == type);
    CHECK(reading.reader.sequence() == sequence);
    const uint8_t* const first = reading.reader.payload();
    CHECK(Bytes(first, first + reading.reader.payload_size()) == payload);
  }
}

TEST_CASE("every golden Command is registered once, with its size") {
  for (const auto& vector : vectors_of("serial_checked")) {
    if (vector.at("direction") != "to_arduino") continue;
    const char type = vector.at("type")[0];
    CAPTURE(type);
    CHECK(registered(type) == 1);
    CommandDefinition command;
    REQUIRE(find_command(type, command));
    CHECK(command.size == bytes_of(vector.at("payload")).size());
    // A handler with its own answer is called when there is room, and its payload is gone by then.
    if (command.answer == Answer::OWN) CHECK(command.size == 0);
  }
  for (int type = 0; type < 256; ++type) {
    const char letter = static_cast<char>(type);
    CHECK(registered(letter) < 2);
    // A message longer than the receive buffer is never found.
    CommandDefinition command;
    CHECK(find_command(letter, command) == (registered(letter) == 1));
  }
}

TEST_CASE("the longest frame is read, one byte more is too long, and the next is read again") {
  Reading reading;
  reading.take(frame_of(1, 'g', Bytes(MAX_PAYLOAD, 0x11)));
  CHECK(reading.frames == 1);
  CHECK(reading.reader.payload_size() == MAX_PAYLOAD);
  CHECK(reading.reader.payload()[MAX_COMMAND - 1] == 0x11);
  Bytes too_long(MAX_FRAME + 2, 0x11);
  too_long[0] = MAX_FRAME + 2;
  too_long.push_back(0);
  reading.take(too_long);
  CHECK(reading.broken == 1);
  reading.take(Bytes(1000, 0xFF));
  reading.take({0});
  CHECK(reading.broken == 2);
  reading.take(frame_of(2, 's', {}));
  CHECK(reading.frames == 2);
}

TEST_CASE("a frame with one wrong bit is rejected and affects no other frame") {
  const Bytes good = frame_of(7, 'u', bytes_of("05dc058f000006400201"));
  for (size_t bit = 0; bit < (good.size() - 1) * 8; ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<uint8_t>(bad[bit / 8] ^ 1 << bit % 8);
    Reading reading;
    reading.take(bad);
    CHECK(reading.frames == 0);
    CHECK(reading.broken >= 1);
    reading.take(good);
    CHECK(reading.frames == 1);
  }
}

TEST_CASE("an unfinished frame ends 100 ms after its first byte, also across the clock's wrap") {
  for (uint32_t begin_us : {0u, 5000u, 0xFFFFFFF0u}) {
    Reading reading;
    CHECK_FALSE(reading.reader.expire(begin_us + 500000));
    reading.take({5, 1}, begin_us);
    reading.take({1}, begin_us + 99000);
    CHECK_FALSE(reading.reader.expire(begin_us + 99999));
    // It counts in steps of 1024 us.
    CHECK(reading.reader.expire(begin_us + 102048));
    CHECK_FALSE(reading.reader.expire(begin_us + 300000));
    reading.take({0}, begin_us + 300000);
    CHECK(reading.broken == 0);
  }
}
