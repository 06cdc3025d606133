#include "common/idl/ros2msg.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>
#include <vector>

namespace interlace::idl {
namespace {

using Tokens = std::vector<std::string>;

struct Member {
  std::string type;   // as written in ros2msg, without the array
  std::string array;  // "[6]", "[<=16]" or nothing
  std::string name;
};
struct Structure {
  std::vector<Member> members;
};
struct NamedType {
  std::string type, array;
};
/// What the text declares.
struct Declarations {
  std::map<std::string, Structure> structures;
  std::map<std::string, std::vector<std::string>> enums;
  std::map<std::string, NamedType> names;  // typedefs
};

/// Words and single signs, without comments and annotations.
Tokens tokens_of(std::string_view text) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  Tokens tokens;
  for (std::size_t i = 0; i < text.size();) {
    if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else if (text[i] == '@') {
      for (++i; i < text.size() && is_word(text[i]);) ++i;
    } else if (is_word(text[i])) {
      const std::size_t begin = i;
      while (i < text.size() && is_word(text[i])) ++i;
      tokens.emplace_back(text.substr(begin, i - begin));
    } else {
      if (std::isspace(static_cast<unsigned char>(text[i])) == 0) tokens.emplace_back(1, text[i]);
      ++i;
    }
  }
  return tokens;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(tokens_of(text)) {}

  Declarations parse() {
    while (at_ < tokens_.size()) {
      const std::string word = next();
      if (word == "module") {
        (void)next();
        expect("{");
      } else if (word == "const") {
        while (next() != ";") {
        }
      } else if (word == "typedef") {
        NamedType type = read_type();
        const std::string name = next();
        all_.names[name] = std::move(type);
        expect(";");
      } else if (word == "enum") {
        read_enum();
      } else if (word == "struct") {
        read_structure();
      } else if (word == "}") {
        expect(";");
      } else {
        throw std::invalid_argument{"IDL: \"" + word + "\" is not understood"};
      }
    }
    return std::move(all_);
  }

 private:
  std::string next() {
    if (at_ >= tokens_.size()) throw std::invalid_argument{"IDL: the text ends too early"};
    return tokens_[at_++];
  }
  [[nodiscard]] bool next_is(const char* token) const { return at_ < tokens_.size() && tokens_[at_] == token; }
  void expect(const char* token) {
    if (const std::string found = next(); found != token)
      throw std::invalid_argument{std::string{"IDL: expected \""} + token + "\", found \"" + found + "\""};
  }

  NamedType read_type() {
    const std::string word = next();
    static const std::map<std::string, std::string> simple{{"double", "float64"}, {"boolean", "bool"}};
    if (const auto found = simple.find(word); found != simple.end()) return {found->second, ""};
    if (word == "long" || word == "unsigned") {
      if (word == "unsigned") expect("long");
      const bool is_long_long = next_is("long");
      if (is_long_long) ++at_;
      return {(word == "unsigned" ? "uint" : "int") + std::string{is_long_long ? "64" : "32"}, ""};
    }
    if (word == "string") {
      expect("<");
      const std::string bound = next();
      expect(">");
      return {"string<=" + bound, ""};
    }
    if (word == "sequence") {
      expect("<");
      const NamedType of = read_type();
      expect(",");
      const std::string bound = next();
      expect(">");
      if (!of.array.empty()) throw std::invalid_argument{"IDL: a sequence of sequences is not understood"};
      return {of.type, "[<=" + bound + "]"};
    }
    if (const auto found = all_.names.find(word); found != all_.names.end()) return found->second;
    if (all_.enums.count(word) + all_.structures.count(word) == 0) throw std::invalid_argument{"IDL: unknown type \"" + word + "\""};
    return {word, ""};
  }

  void read_enum() {
    auto& values = all_.enums[next()];
    expect("{");
    do values.push_back(next());
    while (next() == ",");
    expect(";");
  }

  void read_structure() {
    const std::string name = next();
    Structure structure;
    expect("{");
    while (!next_is("}")) {
      NamedType type = read_type();
      Member member{std::move(type.type), std::move(type.array), next()};
      if (next_is("[")) {
        expect("[");
        member.array = "[" + next() + "]";
        expect("]");
      }
      expect(";");
      structure.members.push_back(std::move(member));
    }
    expect("}");
    expect(";");
    all_.structures[name] = std::move(structure);
  }

  Tokens tokens_;
  std::size_t at_ = 0;
  Declarations all_;
};

constexpr const char* kPackage = "interlace/";

/// Constants first, as ROS 2 does; `used` takes the structs it refers to.
std::string definition(const Declarations& all, const std::string& name, std::vector<std::string>& used) {
  std::string constants, fields;
  std::vector<std::string> told;
  for (const Member& m : all.structures.at(name).members) {
    std::string type = m.type;
    if (const auto found = all.enums.find(m.type); found != all.enums.end()) {
      type = "uint32";
      if (std::find(told.begin(), told.end(), m.type) == told.end()) {
        told.push_back(m.type);
        for (std::size_t i = 0; i < found->second.size(); ++i) constants += "uint32 " + found->second[i] + "=" + std::to_string(i) + "\n";
      }
    } else if (all.structures.count(m.type) != 0) {
      type = kPackage + m.type;
      if (std::find(used.begin(), used.end(), m.type) == used.end()) used.push_back(m.type);
    }
    fields += type;
    fields += m.array;
    fields += " " + m.name + "\n";
  }
  return constants + fields;
}

}  // namespace

std::string ros2msg(std::string_view idl, const std::string& name) {
  const Declarations all = Parser{idl}.parse();
  if (all.structures.count(name) == 0) throw std::invalid_argument{"IDL: there is no struct \"" + name + "\""};
  std::vector<std::string> used{name};
  std::string text = definition(all, name, used);
  for (std::size_t i = 1; i < used.size(); ++i) {  // `used` grows
    const std::string next = used[i];
    text += std::string(80, '=') + "\nMSG: " + kPackage + next + "\n" + definition(all, next, used);
  }
  return text;
}

}  // namespace interlace::idl
