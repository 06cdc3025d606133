#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>

#include "common/mcap/types.hpp"

namespace interlace::mcap {

/// Bytes that wait to be written until the end of a file that may take days to come: in a nameless temporary file, which is gone when the
/// process is. Internal to common/mcap. Not thread-safe.
class Spill {
 public:
  void add(const Bytes& bytes);
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Hands over all that was added, piece by piece. False, before anything or in the middle: the temporary file failed.
  [[nodiscard]] bool drain(const std::function<void(const Bytes&)>& take);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
  std::uint64_t size_ = 0;
  bool failed_ = false;
};

}  // namespace interlace::mcap
