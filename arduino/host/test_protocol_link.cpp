#include <doctest/doctest.h>

#include "link_bench.h"
#include "wire_vectors.h"

using namespace raspilot;

TEST_CASE("the line opens with one zero, and nothing streams before a Start Command") {
  LinkBench bench;
  CHECK(bench.take_raw() == Bytes{0});
  bench.run_ms(500);
  CHECK(bench.take_raw().empty());
}

TEST_CASE("a Command is confirmed with its type and sequence") {
  LinkBench bench;
  bench.sequence = 200;
  bench.send('s');
  const std::vector<Message> messages = bench.take();
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].type == 'K');
  CHECK(messages[0].payload == Bytes{'s', 200});
  CHECK(bench.autopilot.link.is_started());
}

TEST_CASE("questions are answered by their values alone") {
  LinkBench bench;
  for (char type : {'m', 'G', 'c'}) {
    bench.send(type);
    bench.run_ms(20);
  }
  CHECK(bench.take_types() == "mGC");
  CHECK(bench.is_clean);
}

TEST_CASE("answers wait for room, in their order, and none is lost") {
  LinkBench bench;
  bench.take();
  bench.clog();
  bench.send('s');
  bench.send('G');
  bench.send('e', {9});
  bench.send('c');
  CHECK(bench.take().empty());
  bench.drain();
  bench.run_ms(40);
  const std::string types = bench.take_types();
  CHECK(types.substr(0, 4) == "KG!C");
  CHECK(bench.is_clean);
  CHECK(bench.autopilot.link.dropped() == 0);
}

TEST_CASE("a Command that could not be answered is not carried out, and counted") {
  LinkBench bench;
  bench.take();
  bench.clog();
  for (int count = 0; count < 4; ++count) bench.send('m');
  bench.send('s');
  CHECK_FALSE(bench.autopilot.link.is_started());
  CHECK(bench.autopilot.link.dropped() == 1);
  bench.drain();
  bench.run_ms(100);
  CHECK(bench.take_types() == "mmmm");
  bench.send('s');
  CHECK(bench.autopilot.link.is_started());
}

TEST_CASE("a full line does not stop streams that are never answered") {
  LinkBench bench;
  bench.clog();
  for (int count = 0; count < 6; ++count) bench.send('m');
  bench.send('v', {1});
  bench.autopilot.authority.update(true, false, false, bench.now_us);
  CHECK((bench.autopilot.authority.vetoes() & VETO_RASPBERRY_PI) != 0);
}

TEST_CASE("a broken frame is dropped and counted; its neighbours are not") {
  const auto good = bytes_of(text_of("serial_checked_bad", "good"));
  for (const auto& vector : vectors_of("serial_checked_bad")) {
    CAPTURE(vector.at("why"));
    LinkBench bench;
    bench.receive(bytes_of(vector.at("wire")));
    CHECK(bench.autopilot.link.dropped() >= 1);
    CHECK_FALSE(bench.autopilot.link.has_received(bench.now_us));
    bench.receive(good);
    CHECK(bench.autopilot.link.has_received(bench.now_us));
  }
}

TEST_CASE("an unfinished frame is dropped after 100 ms though no byte comes") {
  LinkBench bench;
  bench.receive(Bytes{5, 1, 2});
  bench.run_ms(99);
  CHECK(bench.autopilot.link.dropped() == 0);
  bench.run_ms(4);
  CHECK(bench.autopilot.link.dropped() == 1);
  bench.send('m');
  bench.run_ms(5);
  CHECK(bench.take_types() == "m");
}

TEST_CASE("missing frames are counted by their sequence, round the end, and stay at most") {
  LinkBench bench;
  bench.sequence = 254;
  bench.send('v', {0});
  bench.sequence = 1;
  bench.send('v', {0});
  CHECK(bench.autopilot.link.missing() == 2);
  bench.send('v', {0});
  CHECK(bench.autopilot.link.missing() == 2);
  for (int count = 0; count < 300; ++count) {
    bench.sequence = static_cast<uint8_t>(bench.sequence + 250);
    bench.send('v', {0});
  }
  CHECK(bench.autopilot.link.missing() == 65535);
}

TEST_CASE("an unknown type and a wrong size are dropped and refused with their code") {
  LinkBench bench;
  bench.take();
  bench.send('?');
  bench.send('a', {1});
  const std::vector<Message> messages = bench.take();
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].payload == Bytes{'?', 0, 1});
  CHECK(messages[1].payload == Bytes{'a', 1, 2});
  CHECK(bench.autopilot.link.dropped() == 2);
}

TEST_CASE("streams are refused once a second and type, Commands each time") {
  LinkBench bench;
  bench.take();
  for (int count = 0; count < 40; ++count) {
    bench.send('S', Bytes(10));
    bench.send('v', {2});
    bench.run_ms(50);
  }
  const std::string types = bench.take_types();
  CHECK(types.size() >= 4);
  CHECK(types.size() <= 6);
  for (int count = 0; count < 5; ++count) {
    bench.send('M', {'a'});
    bench.run_ms(5);
  }
  CHECK(bench.take_types() == "!!!!!");
}

TEST_CASE("the Raspberry Pi counts as received for one second") {
  LinkBench bench;
  CHECK_FALSE(bench.autopilot.link.has_received(bench.now_us));
  bench.send('v', {0});
  bench.run_ms(999);
  CHECK(bench.autopilot.link.has_received(bench.now_us));
  bench.run_ms(4);
  CHECK_FALSE(bench.autopilot.link.has_received(bench.now_us));
  // A clock shows the same value again after a wrap.
  CHECK_FALSE(bench.autopilot.link.has_received(bench.now_us - 1003000));
}

TEST_CASE("values are taken in range and refused with 3 beyond") {
  struct {
    char type;
    Bytes payload;
  } const refused[] = {
      {'p', {2, 0, 50}},
      {'p', {1, 0, 9}},
      {'p', {1, 0x03, 0xE9}},
      {'p', {1, 0x80, 0}},
      {'M', {'a'}},
      {'M', {'h'}},
      {'u', bytes_of("03e705dc05dc05dc0000")},
      {'u', bytes_of("05dc07d105dc05dc0000")},
      {'u', bytes_of("05dc05dc000105dc0000")},
      {'S', bytes_of("4651000000000000" "00fa")},
      {'S', bytes_of("0000dcd700000000" "00fa")},
      {'S', bytes_of("00000000000003e7" "00fa")},
      {'S', bytes_of("0000000000000000" "0000")},
      {'S', bytes_of("0000000000000000" "00fb")},
      {'v', {2}},
      {'e', {4}},
      {'e', {2}},
  };
  for (const auto& each : refused) {
    CAPTURE(each.type);
    LinkBench bench;
    bench.take();
    bench.send(each.type, each.payload);
    const std::vector<Message> messages = bench.take();
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].type == '!');
    CHECK(messages[0].payload[2] == 3);
  }
  struct {
    char type;
    Bytes payload;
  } const taken[] = {
      {'p', {0, 0, 10}},
      {'p', {1, 0x03, 0xE8}},
      {'v', {1}},
  };
  for (const auto& each : taken) {
    CAPTURE(each.type);
    LinkBench bench;
    bench.take();
    bench.send(each.type, each.payload);
    CHECK(bench.take_types() == (each.type == 'p' ? "K" : ""));
  }
}
