#include "common/ros2/type_description.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

#include "common/ros2/messages.hpp"
#include "common/ros2/names.hpp"

namespace interlace::ros2 {
namespace {

// As ROS 2 Jazzy publishes them, in the JSON files beside its messages and on the wire. A hash covers names, members, their order and types
// of a message and of all that is in it, so these alone prove that messages.hpp says the same as ROS 2.
TEST(TypeHash, EqualsThePublishedOnes) {
  EXPECT_EQ(type_hash(describe<JointState>()), "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
  EXPECT_EQ(type_hash(describe<TFMessage>()), "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  EXPECT_EQ(type_hash(describe<String>()), "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(type_hash(describe<MarkerArray>()), "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf");
  EXPECT_EQ(type_hash(describe<DiagnosticArray>()), "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
  EXPECT_EQ(type_hash(describe<KeyValue>()), "RIHS01_d68081eaa540288c5440753baecef0c4e16e81a5f78ad68902ded5100413bb42");
  EXPECT_EQ(type_hash(describe<Header>()), "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
  EXPECT_EQ(type_hash(describe<CompressedImage>()), "RIHS01_15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a");
}

TEST(TypeHash, IsOfTheTextThatRep2016Prescribes) {
  EXPECT_EQ(canonical_json(describe<String>()),
            R"({"type_description": {"type_name": "std_msgs/msg/String", "fields": [{"name": "data", "type": {"type_id": 17, )"
            R"("capacity": 0, "string_capacity": 0, "nested_type_name": ""}}]}, "referenced_type_descriptions": []})");
  const std::string header = canonical_json(describe<Header>());
  EXPECT_NE(header.find(R"("referenced_type_descriptions": [{"type_name": "builtin_interfaces/msg/Time", "fields": [{"name": "sec")"),
            std::string::npos)
      << header;
}

TEST(TypeHash, ChangesWithAName) {
  TypeDescription type = describe<JointState>();
  const std::string hash = type_hash(type);
  type.fields[1].name = "names";
  EXPECT_NE(type_hash(type), hash);
}

/// The structs of idl/ros2.idl by their DDS names. Reads the plain style of that file and nothing more.
std::map<std::string, std::vector<Field>> structs_of_the_idl() {
  std::ifstream file{INTERLACE_ROS2_IDL};
  EXPECT_TRUE(file) << INTERLACE_ROS2_IDL;
  static const std::map<std::string, FieldKind> kinds{
      {"uint8", FieldKind::uint8},    {"long", FieldKind::int32},      {"unsigned long", FieldKind::uint32}, {"float", FieldKind::float32},
      {"double", FieldKind::float64}, {"boolean", FieldKind::boolean}, {"octet", FieldKind::byte},           {"string", FieldKind::string}};
  const std::regex module{R"(module (\w+) \{ module msg \{ module dds_ \{)"}, begin{R"(@final struct (\w+) \{)"};
  const std::regex member{R"(  (?:sequence<([\w: ]+)>|([\w: ]+)) (\w+);.*)"};
  std::map<std::string, std::vector<Field>> structs;
  std::string line, package, name;
  std::smatch match;
  while (std::getline(file, line)) {
    if (std::regex_match(line, match, module)) {
      package = match[1];
    } else if (std::regex_match(line, match, begin)) {
      name = package + "::msg::dds_::" + match[1].str();
      structs[name];
    } else if (std::regex_match(line, match, member)) {
      const bool sequence = match[1].matched;
      const std::string type = sequence ? match[1] : match[2];
      const auto kind = kinds.find(type);
      const bool plain = kind != kinds.end();
      structs[name].push_back({match[3], plain ? kind->second : FieldKind::nested, sequence, plain ? "" : type});
    }
  }
  return structs;
}

// The IDL that others read with says what is written.
TEST(Ros2Idl, SaysWhatTheMessagesSay) {
  auto structs = structs_of_the_idl();
  std::map<std::string, std::vector<Field>> messages;
  for (const TypeDescription& type :
       {describe<JointState>(), describe<TFMessage>(), describe<String>(), describe<MarkerArray>(), describe<DiagnosticArray>()}) {
    messages[type.name] = type.fields;
    messages.insert(type.referenced.begin(), type.referenced.end());
  }
  EXPECT_EQ(structs.size(), messages.size());
  for (auto [name, fields] : messages) {
    for (Field& field : fields) {
      if (!field.nested.empty()) field.nested = dds_type(field.nested);
    }
    EXPECT_EQ(structs[dds_type(name)], fields) << name;
  }
}

}  // namespace
}  // namespace interlace::ros2
