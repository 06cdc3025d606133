#include "simulator/reproduce/markdown.hpp"

#include <fmt/format.h>

namespace interlace::reproduce {

namespace {

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += ' ';
    for (const char c : cell) {
      if (c == '|') text += '\\';
      text += c;
    }
    text += " |";
  }
  return text + '\n';
}

/// Whether all cells of a column hold numbers, or that there is none.
bool is_numeric(const std::vector<std::vector<std::string>>& rows, std::size_t column) {
  for (const auto& row : rows) {
    const std::string& cell = row[column];
    const bool digit = !cell.empty() && ((cell[0] >= '0' && cell[0] <= '9') || cell[0] == '-');
    if (!digit && cell != "–" && cell != "not run") return false;
  }
  return true;
}

}  // namespace

std::string markdown_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string text = line(header) + "|";
  for (std::size_t i = 0; i < header.size(); ++i) text += is_numeric(rows, i) ? "---:|" : "---|";
  text += '\n';
  for (const auto& row : rows) text += line(row);
  return text;
}

std::string counted(std::size_t count, const std::string& noun) {
  if (count == 0) return fmt::format("no {}s", noun);
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace interlace::reproduce
