#include "common/app/config/document.hpp"

#include <yaml-cpp/eventhandler.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace interlace::app {

namespace {

struct Refusal {
  YAML::Mark mark;
  std::string rule;
};

/// Looks at the events of a document before nodes are built from them: building recurses, so depth must be known first.
class ShapeGuard : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) throw Refusal{mark, "expected one YAML document, this is the start of a second"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { refuse_anchor(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { throw Refusal{mark, kNoAnchors}; }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor, const std::string& /*value*/) override {
    refuse_anchor(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*s*/) override {
    enter(mark, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor, YAML::EmitterStyle::value /*s*/) override {
    enter(mark, anchor);
  }
  void OnMapEnd() override { --depth_; }

 private:
  static constexpr const char* kNoAnchors = "anchors and aliases are not allowed: write the value out";

  static void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) throw Refusal{mark, kNoAnchors};
  }
  void enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    if (++depth_ > kMaxDepth) throw Refusal{mark, "nested more than " + std::to_string(kMaxDepth) + " deep"};
  }

  int depth_ = 0;
  int documents_ = 0;
};

/// Bytes of the UTF-8 character that starts at `i`; 0 when there is none or it is a control character. Overlong forms are not told apart.
std::size_t character_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) return first >= 0x20 ? (first != 0x7f ? 1 : 0) : (first == '\n' || first == '\r' || first == '\t' ? 1 : 0);
  const std::size_t length =
      first >= 0xc2 && first < 0xe0 ? 2 : (first >= 0xe0 && first < 0xf0 ? 3 : (first >= 0xf0 && first < 0xf5 ? 4 : 0));
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = i + 1; k < i + length; ++k) {
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  }
  return length;
}

bool is_text(const std::string& text, Findings& findings) {
  int line = 1;
  int column = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      findings.add(line, column, "", "", "not a text file: this byte is no printable UTF-8 character");
      return false;
    }
    column = text[i] == '\n' ? 1 : column + 1;
    if (text[i] == '\n') ++line;
    i += length;
  }
  return true;
}

void refuse_size(Findings& findings) {
  findings.add(0, 0, "", "", "larger than " + std::to_string(kMaxFileSize / 1024) + " KiB; no cell or program needs that");
}

}  // namespace

std::optional<std::string> read_file(const std::string& path, Findings& findings) {
  const auto refuse = [&](const std::string& rule) {
    findings.add(0, 0, "", "", rule);
    return std::nullopt;
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return refuse("no such file");
  if (error) return refuse("cannot be read: " + error.message());
  if (status.type() == std::filesystem::file_type::directory) return refuse("is a directory, expected a file");

  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(std::string{"cannot be read: "} + std::strerror(errno));
  std::string text(kMaxFileSize + 1, '\0');  // one byte more than allowed tells an endless file from a full one
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return refuse(std::string{"cannot be read: "} + std::strerror(errno));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxFileSize) {
    refuse_size(findings);
    return std::nullopt;
  }
  return text;
}

std::optional<YAML::Node> parse_document(const std::string& text, Findings& findings) {
  if (text.size() > kMaxFileSize) {
    refuse_size(findings);
    return std::nullopt;
  }
  if (!is_text(text, findings)) return std::nullopt;
  try {
    std::istringstream events(text);
    YAML::Parser parser(events);
    ShapeGuard guard;
    while (parser.HandleNextDocument(guard)) {
    }
    return YAML::Load(text);
  } catch (const Refusal& refusal) {
    findings.add(refusal.mark.line + 1, refusal.mark.column + 1, "", "", refusal.rule);
  } catch (const YAML::Exception& error) {
    findings.add(error.mark.line + 1, error.mark.column + 1, "", "", "not valid YAML: " + error.msg);
  }
  return std::nullopt;
}

}  // namespace interlace::app
