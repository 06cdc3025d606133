#include "common/app/config/finding.hpp"

#include <algorithm>
#include <tuple>

namespace interlace::app {

std::string to_string(const Finding& finding) {
  std::string text = finding.file;
  if (finding.line > 0) text += ":" + std::to_string(finding.line) + ":" + std::to_string(finding.column);
  text += ": ";
  if (!finding.key.empty()) text += finding.key + ": ";
  if (!finding.found.empty()) text += "found " + finding.found + ", ";
  return text + finding.rule;
}

std::string to_string(const ConfigError& error) {
  std::string text;
  for (const auto& finding : error.findings) {
    if (!text.empty()) text += '\n';
    text += to_string(finding);
  }
  return text;
}

void Findings::add(int line, int column, std::string key, std::string found, std::string rule) {
  ++count_;
  if (findings_.size() < kMost) findings_.push_back({file_, line, column, std::move(key), std::move(found), std::move(rule)});
}

ConfigError Findings::error() const {
  ConfigError error{findings_};
  std::stable_sort(error.findings.begin(), error.findings.end(),
                   [](const Finding& a, const Finding& b) { return std::tie(a.line, a.column) < std::tie(b.line, b.column); });
  if (count_ > findings_.size())
    error.findings.push_back({file_, 0, 0, "", "", "and " + std::to_string(count_ - findings_.size()) + " more"});
  return error;
}

}  // namespace interlace::app
