/** The payloads of tests/vectors/serial_checked.json, read when the test runs. */
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace raspilot {

inline std::vector<uint8_t> bytes_of(const std::string& hex) {
  std::vector<uint8_t> bytes;
  for (size_t at = 0; at + 1 < hex.size(); at += 2) {
    bytes.push_back(static_cast<uint8_t>(std::stoul(hex.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

/** Every payload of this type in the golden vectors, both directions. */
inline std::vector<std::vector<uint8_t>> payloads_of(const std::string& type) {
  std::ifstream file(VECTORS "/serial_checked.json");
  std::vector<std::vector<uint8_t>> payloads;
  const nlohmann::json page = nlohmann::json::parse(file);
  for (const auto& vector : page["vectors"]) {
    if (vector["type"] == type) payloads.push_back(bytes_of(vector["payload"]));
  }
  return payloads;
}

}  // namespace raspilot
