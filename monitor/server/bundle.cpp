#include "monitor/server/bundle.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace interlace::monitor {

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::string>& types() {
  static const std::map<std::string, std::string> known{{".html", "text/html; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".json", "application/json; charset=utf-8"},
                                                        {".svg", "image/svg+xml"},
                                                        {".png", "image/png"},
                                                        {".ico", "image/x-icon"},
                                                        {".woff2", "font/woff2"},
                                                        {".txt", "text/plain; charset=utf-8"}};
  return known;
}

}  // namespace

model::Result<Bundle, std::string> Bundle::load(const std::string& folder) {
  std::error_code error;
  Bundle bundle;
  std::size_t bytes = 0;
  for (fs::recursive_directory_iterator it{folder, error}, end; !error && it != end; it.increment(error)) {
    if (!it->is_regular_file(error)) continue;
    const auto type = types().find(it->path().extension().string());
    if (type == types().end()) continue;
    std::ifstream in{it->path(), std::ios::binary};
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) return model::unexpected(it->path().string() + ": cannot be read");
    const std::string name = "/" + it->path().lexically_relative(folder).generic_string();
    bytes += text.str().size();
    if (bytes > kMostBytes)
      return model::unexpected(folder + ": more than " + std::to_string(kMostBytes) + " bytes, not a page of this program");
    bundle.add(name, {type->second, text.str(), name.rfind("/assets/", 0) == 0});
  }
  if (error) return model::unexpected(folder + ": " + error.message());
  if (bundle.find("/") == nullptr) return model::unexpected(folder + ": there is no index.html in it");
  return bundle;
}

const BundleFile* Bundle::find(std::string_view target) const {
  const std::string_view name = target.substr(0, target.find('?'));
  const auto found = files_.find(name == "/" ? std::string_view{"/index.html"} : name);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace interlace::monitor
