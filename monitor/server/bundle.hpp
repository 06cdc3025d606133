#pragma once

#include <map>
#include <string>
#include <string_view>

#include "common/model/result.hpp"

namespace interlace::monitor {

struct BundleFile {
  std::string type;  ///< Content-Type
  std::string body;
  bool immutable = false;  ///< its name changes with its content, so that it may be kept for ever
};

/// The files of the page, read once into memory. What a viewer asks for is looked up in this table by its exact name and nothing else, so
/// there is no path that leads outside. Immutable; thread-safe.
class Bundle {
 public:
  static constexpr std::size_t kMostBytes = 32U << 20U;

  Bundle() = default;
  /// Reads `folder` and what is below it: files a page is made of, by their extensions; others are left out. An error says what is wrong:
  /// no such folder, no index.html in it, more than kMostBytes.
  [[nodiscard]] static model::Result<Bundle, std::string> load(const std::string& folder);

  /// Under its name in a URL, "/assets/index.js"; a query is cut off, "/" is the page itself. Null: not here.
  [[nodiscard]] const BundleFile* find(std::string_view target) const;

  void add(const std::string& name, BundleFile file) { files_[name] = std::move(file); }
  [[nodiscard]] std::size_t size() const { return files_.size(); }

 private:
  std::map<std::string, BundleFile, std::less<>> files_;
};

}  // namespace interlace::monitor
