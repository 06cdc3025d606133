#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace interlace::test {

/// Why `xml` is not well-formed, as far as the pictures use XML: elements nest, attributes are quoted, no stray '&' or '<'. Empty when it
/// is.
inline std::string fault_in_xml(const std::string& xml) {
  std::vector<std::string> open;
  bool root_closed = false;
  for (std::size_t i = 0; i < xml.size();) {
    if (xml[i] == '&') {
      const std::string rest = xml.substr(i, 6);
      bool known = false;
      for (const char* entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) known = known || rest.rfind(entity, 0) == 0;
      if (!known) return "stray & at " + std::to_string(i);
      ++i;
    } else if (xml[i] != '<') {
      if (open.empty() && xml[i] != '\n') return "text outside the root at " + std::to_string(i);
      ++i;
    } else {
      if (root_closed) return "second root at " + std::to_string(i);
      std::size_t end = i + 1;
      bool quoted = false;
      for (; end < xml.size() && (quoted || xml[end] != '>'); ++end) {
        if (xml[end] == '"') quoted = !quoted;
        if (xml[end] == '<') return "< inside a tag at " + std::to_string(end);
      }
      if (end == xml.size()) return "tag without end at " + std::to_string(i);
      const std::string tag = xml.substr(i + 1, end - i - 1);
      const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
      if (tag[0] == '/') {
        if (open.empty() || open.back() != tag.substr(1)) return "</" + tag.substr(1) + "> closes nothing";
        open.pop_back();
        root_closed = open.empty();
      } else if (tag.back() != '/') {
        open.push_back(name);
      }
      i = end + 1;
    }
  }
  return open.empty() && root_closed ? "" : "not closed";
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

}  // namespace interlace::test
