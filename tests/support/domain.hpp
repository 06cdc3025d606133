#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace interlace::test {

/// A DDS domain id that no other test on this machine uses as long as this object lives: a lock on a file in the temporary directory,
/// which the kernel gives back however the process ends. Child processes that inherit nothing may use the id meanwhile.
class Domain {
 public:
  /// Throws std::runtime_error when all ids are taken.
  Domain() {
    for (std::uint32_t candidate = kFirst; candidate <= kLast; ++candidate) {
      const auto path = std::filesystem::temp_directory_path() / ("interlace-test-domain-" + std::to_string(candidate) + ".lock");
      const int fd = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
      if (fd < 0) continue;
      if (::flock(fd, LOCK_EX | LOCK_NB) == 0) {
        fd_ = fd;
        id_ = candidate;
        return;
      }
      ::close(fd);
    }
    throw std::runtime_error{"no free DDS domain id for a test"};
  }
  ~Domain() { ::close(fd_); }
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  // 98 is the last whose ports (7400 + 250 · id + …) lie below the ephemeral ports of Linux; the low ones are what people use.
  static constexpr std::uint32_t kFirst = 20;
  static constexpr std::uint32_t kLast = 98;

  int fd_ = -1;
  std::uint32_t id_ = 0;
};

/// The domain of this test program, locked for as long as it runs.
inline std::uint32_t unique_domain() {
  static const Domain domain;
  return domain.id();
}

}  // namespace interlace::test
