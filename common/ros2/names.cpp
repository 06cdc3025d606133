#include "common/ros2/names.hpp"

#include <algorithm>

namespace interlace::ros2 {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

}  // namespace

std::string topic_part(std::string_view name) {
  std::string part{name};
  std::replace_if(
      part.begin(), part.end(), [](char c) { return !is_word(c); }, '_');
  return part.empty() || is_digit(part.front()) ? "_" + part : part;
}

std::string dds_topic(std::string_view topic) {
  return "rt" + std::string{topic};
}

std::string dds_type(std::string_view type) {
  std::string name;
  const auto last = type.rfind('/');
  for (const char c : type.substr(0, last + 1)) name += c == '/' ? "::" : std::string(1, c);
  return name + "dds_::" + std::string{type.substr(last + 1)} + "_";
}

}  // namespace interlace::ros2
