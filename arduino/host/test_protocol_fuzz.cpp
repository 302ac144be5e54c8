#include <dirent.h>
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/link_script.h"
#include "link_bench.h"

using namespace raspilot;

namespace {

const std::string CORPUS = VECTORS "/../../arduino/host/fuzz/corpus";

std::vector<std::string> kept_scripts() {
  std::vector<std::string> names;
  DIR* const folder = opendir(CORPUS.c_str());
  REQUIRE(folder != nullptr);
  while (const dirent* entry = readdir(folder)) {
    if (entry->d_name[0] != '.') names.push_back(entry->d_name);
  }
  closedir(folder);
  return names;
}

Bytes contents(const std::string& name) {
  std::ifstream file(CORPUS + "/" + name, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

ScriptEnd play(const Bytes& script) { return raspilot::play(script.data(), script.size()); }

}  // namespace

TEST_CASE("every kept script of the fuzzer keeps the rules") {
  const std::vector<std::string> names = kept_scripts();
  CHECK(names.size() >= 20);
  unsigned armed = 0;
  for (const std::string& name : names) {
    const ScriptEnd end = play(contents(name));
    armed += end.is_armed;
  }
  // The rule is effective: some of the scripts reach the state where it could be broken.
  CHECK(armed > 0);
}

TEST_CASE("a script's Arm Command arms, and bare bytes of it do as well when they are a frame") {
  CHECK(play({0xC0, 'a'}).is_armed);
  Bytes bare = LinkBench::frame_of(9, 'a', {});
  bare.insert(bare.begin(), static_cast<uint8_t>(bare.size()));
  CHECK(play(bare).is_armed);
  bare[3] ^= 1;
  CHECK_FALSE(play(bare).is_armed);
}

TEST_CASE("random bytes with pauses do not arm") {
  std::mt19937 random(7);
  for (int count = 0; count < 40; ++count) {
    Bytes script;
    for (int record = 0; record < 40; ++record) {
      script.push_back(0x7F);
      for (int at = 0; at < 0x7F; ++at) script.push_back(static_cast<uint8_t>(random()));
      script.push_back(static_cast<uint8_t>(0x80 + random() % 0x40));
    }
    const ScriptEnd end = play(script);
    CHECK_FALSE(end.is_armed);
  }
}
