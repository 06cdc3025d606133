#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

constexpr int kMutations = 2000;
constexpr unsigned kSeed = 417;

/// Breaks a text in ways people, editors and disks do.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) mutate(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>{0, n - 1}(random_); }

  void mutate(std::string& text) {
    static const std::vector<std::string> words{
        ".nan", "nan",  "-nan", ".inf", "-.inf", "1e999", "-1",    "0",  "1e-320", "99999999999999999999",
        "~",    "[]",   "{}",   "\"\"", "&a",    "*a",    "!!int", ": ", "- ",     "\t",
        "\n",   "\x01", "#",    "|",    ">",     "%YAML", "---\n", "'",  "\"",     "<<"};
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(20);
    switch (below(6)) {
      case 0: text[at] = static_cast<char>(below(256)); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(at, text.substr(below(text.size()), length)); break;
      case 3: text.insert(at, words[below(words.size())]); break;
      case 4: replace_token(text, at, words[below(words.size())]); break;
      default: text.resize(at); break;
    }
  }

  /// Replaces the number or word at `at`.
  static void replace_token(std::string& text, std::size_t at, const std::string& word) {
    const char* borders = " ,:[]{}\n";
    const auto before = text.find_last_of(borders, at);
    const auto after = text.find_first_of(borders, at);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = after == std::string::npos ? text.size() : after;
    if (begin < end) text.replace(begin, end - begin, word);
  }

  std::mt19937 random_;
};

void expect_sound(const model::Cell& cell) {
  EXPECT_TRUE(model::is_valid_name(cell.name));
  EXPECT_FALSE(cell.robots.empty());
  EXPECT_TRUE(cell.planning.resolution > 0.0005 && cell.planning.resolution <= 1);
  EXPECT_TRUE(std::isfinite(cell.planning.margin) && cell.planning.margin >= 0);
  for (const auto& robot : cell.robots) {
    EXPECT_TRUE(model::is_valid_name(robot.name.str()));
    EXPECT_TRUE(robot.start.allFinite() && robot.home.allFinite());
    EXPECT_TRUE(robot.X_WB.matrix().allFinite() && robot.model.X_FT.matrix().allFinite());
    EXPECT_TRUE(robot.model.joints.min.allFinite() && robot.model.joints.max.allFinite());
    EXPECT_FALSE(model::joint_outside_limits(robot.model.joints, robot.start));
    EXPECT_FALSE(model::joint_outside_limits(robot.model.joints, robot.home));
    EXPECT_TRUE(std::isfinite(robot.tcp.velocity) && robot.tcp.velocity > 0);
    EXPECT_TRUE(std::isfinite(robot.tcp.acceleration) && robot.tcp.acceleration > 0);
    for (const auto& capsule : robot.model.capsules) {
      EXPECT_TRUE(capsule.a.allFinite() && capsule.b.allFinite() && std::isfinite(capsule.radius) && capsule.radius > 0);
      EXPECT_LE(capsule.link, 6U);
    }
  }
}

void expect_told(const ConfigError& error) {
  ASSERT_FALSE(error.findings.empty());
  for (const auto& finding : error.findings) EXPECT_FALSE(finding.rule.empty());
}

TEST(Mutations, OfAGoodCellAreRefusedWithReasonsOrSound) {
  std::cout << "seed " << kSeed << ", " << kMutations << " mutations\n";
  Mutator mutate{kSeed};
  int accepted = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string text = mutate(samples::kCell);
    const auto result = parse_cell(text, "cell.yaml");
    accepted += result ? 1 : 0;
    if (result) expect_sound(result->cell);
    if (!result) expect_told(result.error());
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << kSeed << ", mutation " << i << ":\n" << text;
  }
  std::cout << accepted << " accepted\n";
  EXPECT_LT(accepted, kMutations / 2);
}

TEST(Mutations, OfAGoodProgramAreRefusedWithReasonsOrSound) {
  std::cout << "seed " << kSeed << ", " << kMutations << " mutations\n";
  Mutator mutate{kSeed};
  for (int i = 0; i < kMutations; ++i) {
    const std::string text = mutate(samples::kProgram);
    const auto result = parse_program(text, "program.yaml", nullptr);
    if (!result) expect_told(result.error());
    if (result) {
      EXPECT_GT(result->size(), 0U);
      for (const auto& [robot, steps] : result->robots) {
        EXPECT_TRUE(model::is_valid_name(robot.str()));
        for (const auto& step : steps) {
          if (const auto* line = std::get_if<model::LinearTarget>(&step.motion.target)) {
            EXPECT_TRUE(line->X_WT.matrix().allFinite());
          }
          if (const auto* joint = std::get_if<model::JointTarget>(&step.motion.target)) {
            EXPECT_TRUE(joint->q.allFinite());
          }
          EXPECT_TRUE(std::isfinite(step.at) && step.at >= 0);
        }
      }
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << kSeed << ", mutation " << i << ":\n" << text;
  }
}

}  // namespace
}  // namespace interlace::app
