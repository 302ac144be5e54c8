/** The golden vectors of tests/vectors, read when the test runs. */
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace raspilot {

/** The members of one vector; those that are not text, as JSON. */
typedef std::map<std::string, std::string> WireVector;

std::vector<uint8_t> bytes_of(const std::string& hex);
std::vector<WireVector> vectors_of(const std::string& name);
/** A text beside the vectors of a file. */
std::string text_of(const std::string& name, const std::string& member);
/** Every payload of this type in serial_checked.json, both directions. */
std::vector<std::vector<uint8_t>> payloads_of(const std::string& type);

}  // namespace raspilot
