#include "wire_vectors.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace raspilot {

namespace {

nlohmann::json page_of(const std::string& name) {
  std::ifstream file(VECTORS "/" + name + ".json");
  return nlohmann::json::parse(file);
}

}  // namespace

std::vector<uint8_t> bytes_of(const std::string& hex) {
  std::vector<uint8_t> bytes;
  for (size_t at = 0; at + 1 < hex.size(); at += 2) {
    bytes.push_back(static_cast<uint8_t>(std::stoul(hex.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

std::vector<WireVector> vectors_of(const std::string& name) {
  std::vector<WireVector> vectors;
  const nlohmann::json page = page_of(name);
  for (const auto& vector : page["vectors"]) {
    WireVector members;
    for (const auto& each : vector.items()) {
      const auto& value = each.value();
      members[each.key()] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    vectors.push_back(members);
  }
  if (vectors.size() < 3) throw std::runtime_error("too few vectors in " + name);
  return vectors;
}

std::string text_of(const std::string& name, const std::string& member) {
  return page_of(name)[member].get<std::string>();
}

std::vector<std::vector<uint8_t>> payloads_of(const std::string& type) {
  std::vector<std::vector<uint8_t>> payloads;
  for (const WireVector& vector : vectors_of("serial_checked")) {
    if (vector.at("type") == type) payloads.push_back(bytes_of(vector.at("payload")));
  }
  return payloads;
}

}  // namespace raspilot
