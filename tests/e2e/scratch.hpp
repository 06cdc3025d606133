#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace interlace::test {

/// A folder of a test's own, gone with this object.
class Scratch {
 public:
  /// Throws std::runtime_error.
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "interlace-e2e-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error{"no scratch folder"};
    folder_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes `text` to the file `name` and returns its path. Throws std::runtime_error.
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream out{path(name), std::ios::binary};
    out << text;
    out.close();
    if (!out) throw std::runtime_error{"cannot write " + path(name)};
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

/// The whole file; empty when it cannot be read.
inline std::string read_text(const std::string& path) {
  std::ifstream in{path, std::ios::binary};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace interlace::test
