#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/app/config/finding.hpp"
#include "common/app/config/quantity.hpp"
#include "common/model/pose.hpp"

namespace interlace::app {

class Mapping;

/// A value in a file together with the path of its key and the place where complaints about it go. Every reading either yields a checked
/// value or adds a finding and yields nothing, so that one pass tells everything wrong with a file.
class Field {
 public:
  Field(const YAML::Node& node, std::string key, Findings& findings) : Field(node, std::move(key), findings, node.Mark()) {}
  /// `place` is where the key itself stands.
  Field(const YAML::Node& node, std::string key, Findings& findings, YAML::Mark place)
      : node_(node), key_(std::move(key)), findings_(&findings), place_(place) {}

  [[nodiscard]] const std::string& key() const { return key_; }

  /// Complains about this value; the message shows it as written.
  void refuse(const std::string& rule) const;
  /// Complains about the key or its place, without showing the value.
  void complain(const std::string& rule) const;
  /// Complains at this place about a key that should be in this mapping.
  void complain_missing(const std::string& key) const;

  /// A number in SI units. Finite always.
  [[nodiscard]] std::optional<double> number(const Quantity& quantity) const;
  [[nodiscard]] std::optional<int> integer(int least, int most) const;
  [[nodiscard]] std::optional<std::string> text() const;
  /// A text that model::is_valid_name accepts.
  [[nodiscard]] std::optional<std::string> name() const;
  /// Index in `choices` of this text; complains with all of them, and the likeliest.
  [[nodiscard]] std::optional<std::size_t> one_of(const std::vector<std::string>& choices) const;

  [[nodiscard]] bool is_list() const { return node_.IsSequence(); }
  [[nodiscard]] bool is_mapping() const { return node_.IsMap(); }

  /// Elements of a list; empty optional, with a finding, when this is none.
  [[nodiscard]] std::optional<std::vector<Field>> items(const std::string& what) const;
  /// A list of exactly `count` numbers.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::size_t count, const Quantity& quantity) const;
  [[nodiscard]] std::optional<model::Vector3> vector(const Quantity& quantity) const;
  [[nodiscard]] std::optional<model::Joints> joints(const Quantity& quantity) const;

  /// A mapping whose keys are all in `known`; unknown and repeated keys are complained about. Any key goes when `known` is empty.
  /// Yields what could be read even after a complaint about a key; nothing when this is no mapping.
  [[nodiscard]] std::optional<Mapping> mapping(const std::vector<std::string>& known) const;

 private:
  [[nodiscard]] std::optional<double> plain_number(const std::string& expected) const;

  YAML::Node node_;
  std::string key_;
  Findings* findings_;
  YAML::Mark place_;
};

/// The entries of a mapping, in the order of the file, keys unique.
class Mapping {
 public:
  Mapping(Field self, std::vector<std::pair<std::string, Field>> entries) : self_(std::move(self)), entries_(std::move(entries)) {}

  [[nodiscard]] const Field& self() const { return self_; }
  [[nodiscard]] const std::vector<std::pair<std::string, Field>>& entries() const { return entries_; }
  [[nodiscard]] std::optional<Field> find(const std::string& key) const;
  /// Like find, but its absence is complained about.
  [[nodiscard]] std::optional<Field> require(const std::string& key) const;

 private:
  Field self_;
  std::vector<std::pair<std::string, Field>> entries_;
};

/// " (did you mean \"velocity\"?)" when one of `choices` is near `word`, else nothing.
[[nodiscard]] std::string did_you_mean(const std::string& word, const std::vector<std::string>& choices);

/// `a, b or c`.
[[nodiscard]] std::string listed(const std::vector<std::string>& words);

}  // namespace interlace::app
