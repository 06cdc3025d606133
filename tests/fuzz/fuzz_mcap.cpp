#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "common/mcap/reader.hpp"

/// Any bytes are refused with a reason or give messages of known channels, and come to an end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in{std::string(data, data + size)};
  interlace::mcap::Reader reader{in};
  for (;;) {
    const auto message = reader.next();
    if (!message && message.error().empty()) std::abort();
    if (!message || !*message) return 0;
    if (reader.channels().count((*message)->channel) == 0) std::abort();
  }
}
