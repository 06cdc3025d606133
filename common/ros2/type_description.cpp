#include "common/ros2/type_description.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace interlace::ros2 {

namespace {

std::string individual_json(const std::string& name, const std::vector<Field>& fields) {
  std::string json = fmt::format(R"({{"type_name": "{}", "fields": [)", name);
  const char* separator = "";
  for (const Field& field : fields) {
    json += fmt::format(R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": 0, "string_capacity": 0, "nested_type_name": "{}"}}}})",
                        std::exchange(separator, ", "), field.name,
                        static_cast<int>(field.kind) + (field.sequence ? kUnboundedSequence : 0), field.nested);
  }
  return json + "]}";
}

}  // namespace

std::string canonical_json(const TypeDescription& type) {
  std::string json = R"({"type_description": )" + individual_json(type.name, type.fields) + R"(, "referenced_type_descriptions": [)";
  const char* separator = "";
  for (const auto& [name, fields] : type.referenced) json += std::exchange(separator, ", ") + individual_json(name, fields);
  return json + "]}";
}

std::string type_hash(const TypeDescription& type) {
  const std::string json = canonical_json(type);
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(json.data(), json.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error{"this machine's OpenSSL has no SHA-256"};
  }
  std::string hash = "RIHS01_";
  for (const unsigned char byte : digest) hash += fmt::format("{:02x}", byte);
  return hash;
}

}  // namespace interlace::ros2
