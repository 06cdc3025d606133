#include "common/app/config/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "common/model/ids.hpp"

namespace interlace::app {

namespace {

constexpr std::size_t kShown = 60;        // characters of a value in a message
constexpr std::size_t kLongestWord = 64;  // beyond it nothing is a typing mistake of a key

/// `text` for one line of a terminal, shortened on a character border.
std::string shortened(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
    if (out.size() >= kShown && !continues) return out + "...";
    out += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return out;
}

void write_flow(const YAML::Node& node, std::string& out) {
  if (out.size() > kShown) return;
  const char* separator = "";
  switch (node.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null: out += "~"; break;
    case YAML::NodeType::Scalar: out += node.Scalar().substr(0, kShown + 1); break;
    case YAML::NodeType::Sequence:
      out += "[";
      for (const auto& item : node) {
        out += separator;
        write_flow(item, out);
        separator = ", ";
        if (out.size() > kShown) break;
      }
      out += "]";
      break;
    case YAML::NodeType::Map:
      out += "{";
      for (const auto& entry : node) {
        out += separator;
        write_flow(entry.first, out);
        out += ": ";
        write_flow(entry.second, out);
        separator = ", ";
        if (out.size() > kShown) break;
      }
      out += "}";
      break;
  }
}

std::string shown(const YAML::Node& node) {
  if (node.IsNull()) return "nothing";
  if (node.IsScalar()) return '"' + shortened(node.Scalar()) + '"';
  std::string out;
  write_flow(node, out);
  return shortened(out);
}

/// Levenshtein distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

void add(Findings& findings, const YAML::Mark& mark, std::string key, std::string found, std::string rule) {
  findings.add(mark.line + 1, mark.column + 1, std::move(key), std::move(found), std::move(rule));
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& choices) {
  if (word.size() < 3 || word.size() > kLongestWord) return "";  // every two-letter word is near every other
  std::size_t best = 1 + word.size() / 3;                        // a third of the word may be wrong
  const std::string* nearest = nullptr;
  for (const auto& choice : choices) {
    if (choice.size() > kLongestWord) continue;
    const std::size_t distance = edits(word, choice);
    if (distance < best || (distance == best && nearest == nullptr)) {
      best = distance;
      nearest = &choice;
    }
  }
  return nearest == nullptr ? "" : " (did you mean \"" + *nearest + "\"?)";
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

void Field::refuse(const std::string& rule) const {
  // A value left out has no place of its own: the parser puts it where the next key stands.
  add(*findings_, node_.IsNull() ? place_ : node_.Mark(), key_, shown(node_), rule);
}

void Field::complain(const std::string& rule) const {
  add(*findings_, place_, key_, "", rule);
}

void Field::complain_missing(const std::string& key) const {
  add(*findings_, node_.Mark(), (key_.empty() ? "" : key_ + ".") + key, "", "required key is missing");
}

std::optional<double> Field::plain_number(const std::string& expected) const {
  if (node_.IsScalar()) {
    const std::string& s = node_.Scalar();
    const std::size_t sign = s.size() > 1 && s[0] == '+' && s[1] != '-' ? 1 : 0;  // from_chars knows no plus
    double value = 0;
    const auto [end, error] = std::from_chars(s.data() + sign, s.data() + s.size(), value);
    if (error == std::errc{} && end == s.data() + s.size() && std::isfinite(value)) return value;
  }
  refuse("expected " + expected);
  return std::nullopt;
}

std::optional<double> Field::number(const Quantity& quantity) const {
  const auto value = plain_number(quantity.description());
  if (!value) return std::nullopt;
  const double si = *value / quantity.per_si;
  if ((quantity.positive && si <= 0) || (!quantity.positive && quantity.least == 0 && si < 0)) {
    refuse("expected " + quantity.description());
  } else if (si < quantity.least) {
    refuse("expected at least " + show(quantity.least, quantity));
  } else if (si > quantity.most) {
    refuse("expected at most " + show(quantity.most, quantity));
  } else {
    return si;
  }
  return std::nullopt;
}

std::optional<int> Field::integer(int least, int most) const {
  const std::string expected = fmt::format("expected a whole number from {} to {}", least, most);
  if (node_.IsScalar()) {
    const std::string& s = node_.Scalar();
    int value = 0;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error == std::errc{} && end == s.data() + s.size() && value >= least && value <= most) return value;
  }
  refuse(expected);
  return std::nullopt;
}

std::optional<std::string> Field::text() const {
  if (node_.IsScalar() && !node_.Scalar().empty()) return node_.Scalar();
  refuse("expected a text");
  return std::nullopt;
}

std::optional<std::string> Field::name() const {
  if (node_.IsScalar() && model::is_valid_name(node_.Scalar())) return node_.Scalar();
  refuse(fmt::format("expected a name: 1 to {} letters, digits, '_', '-', '.' or ':'", model::kMaxNameLength));
  return std::nullopt;
}

std::optional<std::size_t> Field::one_of(const std::vector<std::string>& choices) const {
  if (node_.IsScalar()) {
    const auto found = std::find(choices.begin(), choices.end(), node_.Scalar());
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    refuse("expected " + listed(choices) + did_you_mean(node_.Scalar(), choices));
  } else {
    refuse("expected " + listed(choices));
  }
  return std::nullopt;
}

std::optional<std::vector<Field>> Field::items(const std::string& what) const {
  if (!node_.IsSequence()) {
    refuse("expected a list of " + what);
    return std::nullopt;
  }
  std::vector<Field> items;
  for (const auto& item : node_) items.emplace_back(item, key_ + "[" + std::to_string(items.size()) + "]", *findings_);
  return items;
}

std::optional<std::vector<double>> Field::numbers(std::size_t count, const Quantity& quantity) const {
  if (!node_.IsSequence() || node_.size() != count) {
    refuse(fmt::format("expected a list of {} numbers{}", count, quantity.unit.empty() ? "" : " (" + quantity.unit + ")"));
    return std::nullopt;
  }
  std::vector<double> values;
  for (const auto& item : node_) {
    const Field field{item, key_ + "[" + std::to_string(values.size()) + "]", *findings_};
    values.push_back(field.number(quantity).value_or(std::nan("")));
  }
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) return std::nullopt;
  return values;
}

std::optional<model::Vector3> Field::vector(const Quantity& quantity) const {
  const auto values = numbers(3, quantity);
  if (!values) return std::nullopt;
  return model::Vector3{(*values)[0], (*values)[1], (*values)[2]};
}

std::optional<model::Joints> Field::joints(const Quantity& quantity) const {
  const auto values = numbers(model::kJoints, quantity);
  if (!values) return std::nullopt;
  model::Joints q;
  for (std::size_t i = 0; i < model::kJoints; ++i) q[i] = (*values)[i];
  return q;
}

std::optional<Mapping> Field::mapping(const std::vector<std::string>& known) const {
  if (!node_.IsMap()) {
    refuse(known.empty() ? "expected a mapping" : "expected a mapping with the keys " + listed(known));
    return std::nullopt;
  }
  std::vector<std::pair<std::string, Field>> entries;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) {
      add(*findings_, entry.first.Mark(), key_, shown(entry.first), "expected a plain text as key");
      continue;
    }
    const std::string& word = entry.first.Scalar();
    const std::string path = (key_.empty() ? "" : key_ + ".") + shortened(word);
    if (!seen.insert(word).second) {
      add(*findings_, entry.first.Mark(), path, "", "duplicate key: it is already given above");
    } else if (!known.empty() && std::find(known.begin(), known.end(), word) == known.end()) {
      add(*findings_, entry.first.Mark(), path, "", "unknown key" + did_you_mean(word, known));
    } else {
      entries.emplace_back(word, Field{entry.second, path, *findings_, entry.first.Mark()});
    }
  }
  return Mapping{*this, std::move(entries)};
}

std::optional<Field> Mapping::find(const std::string& key) const {
  for (const auto& [name, field] : entries_) {
    if (name == key) return field;
  }
  return std::nullopt;
}

std::optional<Field> Mapping::require(const std::string& key) const {
  auto field = find(key);
  if (!field) self_.complain_missing(key);
  return field;
}

}  // namespace interlace::app
