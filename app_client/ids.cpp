#include "app_client/ids.hpp"

#include <random>
#include <stdexcept>

namespace interlace::client {

std::string make_id(std::string_view prefix) {
  if (!model::is_valid_name(prefix) || prefix.size() > kMaxIdPrefix) {
    throw std::invalid_argument{"id prefix '" + std::string{prefix} + "': expected a valid name of at most " +
                                std::to_string(kMaxIdPrefix) + " bytes"};
  }
  constexpr std::string_view kAlphabet = "0123456789abcdefghjkmnpqrstvwxyz";  // no i, l, o, u: ids are read aloud and typed
  constexpr int kLetters = 12;
  std::random_device source;
  std::string id{prefix};
  id += '-';
  for (int i = 0; i < kLetters; ++i) id += kAlphabet[source() % kAlphabet.size()];
  return id;
}

}  // namespace interlace::client
