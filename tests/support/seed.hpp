#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace interlace::test {

/// Random numbers of one test, with the seed printed so that a failure can be run again. INTERLACE_SEED=<number> replaces the test's own
/// seed, INTERLACE_SEED=random draws a new one.
class Seed {
 public:
  explicit Seed(std::uint64_t own = 1) : value_(chosen(own)), engine_(value_) {
    ::testing::Test::RecordProperty("seed", std::to_string(value_));
    std::printf("[   seed   ] %llu\n", static_cast<unsigned long long>(value_));
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }
  [[nodiscard]] std::mt19937_64& engine() { return engine_; }

  /// Uniform in [low, high).
  [[nodiscard]] double uniform(double low, double high) { return std::uniform_real_distribution<double>{low, high}(engine_); }
  /// Uniform in 0 … n−1.
  [[nodiscard]] std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>{0, n - 1}(engine_); }
  [[nodiscard]] bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  static std::uint64_t chosen(std::uint64_t own) {
    const char* text = std::getenv("INTERLACE_SEED");
    if (text == nullptr || *text == '\0') return own;
    if (std::string{text} == "random") return std::random_device{}();
    return std::strtoull(text, nullptr, 10);
  }

  std::uint64_t value_;
  std::mt19937_64 engine_;
};

/// How many cases to run of a property stated for `full`: INTERLACE_PROPERTY_SCALE=0.01 runs a hundredth, for slow sanitizer builds.
inline std::size_t scaled(std::size_t full) {
  const char* text = std::getenv("INTERLACE_PROPERTY_SCALE");
  const double scale = text != nullptr ? std::strtod(text, nullptr) : 1.0;
  const auto count = static_cast<std::size_t>(static_cast<double>(full) * scale);
  return count > 0 ? count : 1;
}

}  // namespace interlace::test
