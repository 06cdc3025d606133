#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

#include "common/app/config/finding.hpp"

namespace interlace::app {

inline constexpr std::size_t kMaxFileSize = 1U << 20U;  ///< [bytes]
inline constexpr int kMaxDepth = 12;                    ///< of nested lists and mappings; the formats need seven

/// Content of a file of at most kMaxFileSize; empty, with a finding, when it is missing, a directory, unreadable or too large.
/// Blocks as the file system does; any thread.
[[nodiscard]] std::optional<std::string> read_file(const std::string& path, Findings& findings);

/// The one YAML document in `text`; empty, with a finding, when the text is too large, not UTF-8 text, not YAML, nested too deeply, or uses
/// anchors and aliases. All of that is decided before any tree is built, in time linear in the text. Pure.
[[nodiscard]] std::optional<YAML::Node> parse_document(const std::string& text, Findings& findings);

}  // namespace interlace::app
