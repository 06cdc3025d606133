#pragma once

#include <boost/crc.hpp>
#include <cstdint>

#include "common/mcap/types.hpp"

namespace interlace::mcap {

inline constexpr std::uint32_t kNoCrc = 0;  // the format's way to say that none was computed

/// CRC-32 as MCAP wants it (that of zlib). Internal to common/mcap.
inline std::uint32_t checksum(const std::uint8_t* data, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}
inline std::uint32_t checksum(const Bytes& bytes) {
  return checksum(bytes.data(), bytes.size());
}

}  // namespace interlace::mcap
