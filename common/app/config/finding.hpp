#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace interlace::app {

/// One thing wrong in a file, told so that a person can mend it: where, what was found, which rule it breaks.
struct Finding {
  std::string file;
  int line = 0;       ///< from 1; 0 when the file as a whole is meant
  int column = 0;     ///< from 1; 0 when unknown
  std::string key;    ///< path of the key, such as robots[0].tcp.velocity; empty when the file as a whole is meant
  std::string found;  ///< the value as written, shortened; empty when there is none to show
  std::string rule;   ///< what was expected
};

/// Why a file was refused: at least one finding, in the order of the file.
struct ConfigError {
  std::vector<Finding> findings;
};

/// `cell.yaml:12:5: robots[0].tcp.velocity: found "fast", expected a number > 0 (mm/s)`
[[nodiscard]] std::string to_string(const Finding& finding);

/// All findings, one per line, without a newline at the end.
[[nodiscard]] std::string to_string(const ConfigError& error);

/// Collects the findings of one file. After `kMost` it only counts, so that a broken file cannot flood a terminal.
class Findings {
 public:
  static constexpr std::size_t kMost = 50;

  explicit Findings(std::string file) : file_(std::move(file)) {}

  /// `line` and `column` from 1, or 0.
  void add(int line, int column, std::string key, std::string found, std::string rule);

  [[nodiscard]] bool none() const { return count_ == 0; }
  [[nodiscard]] std::size_t count() const { return count_; }

  /// Everything collected, sorted by place in the file.
  [[nodiscard]] ConfigError error() const;

 private:
  std::string file_;
  std::vector<Finding> findings_;
  std::size_t count_ = 0;
};

}  // namespace interlace::app
