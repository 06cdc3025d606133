#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/programs.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/support/arm_shapes.hpp"

// interlace-model fit, seen from outside: from the meshes of an arm to a cell that the simulator runs.
namespace interlace::test {
namespace {

const std::string kModel = INTERLACE_BIN_DIR "/interlace-model";

using Words = std::vector<std::string>;

const Words kKinematics{"--opw", "0", "-70", "0", "290", "270", "302", "72", "--offsets", "0", "0", "-90", "0", "0", "0"};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Two of the arm 700 mm apart.
std::string cell_around(const std::string& block) {
  const auto robot = [](const std::string& name, int y) {
    return fmt::format(
        "  - name: {}\n    model: arm6\n    base: {{xyz: [0, {}, 0], rpy: [0, 0, 0]}}\n    start: {{xyz: [400, {}, 450], rpy: [0, 135, "
        "0]}}\n"
        "    tcp: {{velocity: 500, acceleration: 2000}}\n",
        name, y, y);
  };
  return "interlace: 1\nunits: {length: mm, angle: deg}\ncell: fitted\n" + block + "robots:\n" + robot("r1", 350) + robot("r2", -350);
}

/// Both go to the middle between them and back.
constexpr const char* kProgram = R"(interlace: 1
units: {length: mm, angle: deg}
program:
  r1: [{move: linear, to: {xyz: [420, 20, 400], rpy: [0, 135, 0]}}, {move: linear, to: {xyz: [400, 350, 450], rpy: [0, 135, 0]}}]
  r2: [{move: linear, to: {xyz: [420, -20, 400], rpy: [0, 135, 0]}}, {move: linear, to: {xyz: [400, -350, 450], rpy: [0, 135, 0]}}]
)";

class ModelFit : public testing::Test {
 protected:
  /// Writes the arm's meshes and the file that lists them; returns its path.
  std::string shapes() {
    std::string list = "interlace: 1\nunits: {length: mm, angle: deg}\nshapes:\n";
    for (const auto& [link, mesh] : small_arm_shapes()) {
      const std::string name = fmt::format("link{}.stl", link);
      scratch_.file(name, link % 2 == 0 ? binary_stl(mesh) : ascii_stl(mesh));
      list += fmt::format("  - {{link: {}, mesh: {}}}\n", link, name);
    }
    return scratch_.file("shapes.yaml", list);
  }
  Scratch scratch_;
};

TEST_F(ModelFit, MakesAModelThatTheSimulatorRuns) {
  const Outcome fitted = run(Words{kModel, "fit", shapes(), "--model", "arm6", "--capsules", "3"} + kKinematics, 60s);
  ASSERT_EQ(fitted.exit_code, 0) << fitted;
  EXPECT_TRUE(fitted.errors.empty()) << fitted;
  std::cout << fitted.output;
  EXPECT_EQ(Process::count(fitted.output, " vertices inside by "), 7U) << fitted;
  EXPECT_EQ(Process::count(fitted.output, " more volume than the mesh"), 7U) << fitted;

  const std::string cell = scratch_.file("cell.yaml", cell_around(fitted.output));
  const std::string program = scratch_.file("program.yaml", kProgram);
  const Outcome planned = run({kSim, cell, program, "--json"}, 60s);
  ASSERT_EQ(planned.exit_code, 0) << planned;
  const auto report = nlohmann::json::parse(planned.output).at(0);
  EXPECT_EQ(report["completed"], 4);
  EXPECT_GT(report["min_clearance_m"].get<double>(), 0);
  EXPECT_EQ(run({kSim, cell, program, "--strategy", "direct"}, 60s).exit_code, 3) << "without a planner the fitted bodies meet";

  // A cell file that has the kinematics gives the same block, and so does the program the second time.
  const Words from_cell{kModel, "fit", shapes(), "--model", "arm6", "--capsules", "3", "--cell", cell};
  EXPECT_EQ(run(from_cell, 60s).output, fitted.output);
}

TEST_F(ModelFit, WritesTheBlockAndTellsTheRestAsJson) {
  const std::string mesh = scratch_.file("upper.obj", obj(cylinder(0.05, 0.3), 1));
  const std::string block = scratch_.path("block.yaml");
  const std::string cell = scratch_.file("cell.yaml", read_text(deployed("exp-4-2/cell.yaml")));
  const Outcome o =
      run(Words{kModel, "fit", "--link", "2=" + mesh, "--units", "m", "--model", "arm4", "--cell", cell, "--output", block, "--json"});
  ASSERT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(o.says("warning: no mesh for links 0, 1, 3, 4, 5, 6: nothing will keep clear of them")) << o;
  const auto j = nlohmann::json::parse(o.output).at(0);
  EXPECT_EQ(j["link"], 2);
  EXPECT_EQ(j["vertices"], 96);
  EXPECT_GT(j["inside_m"]["least"].get<double>(), 0);
  EXPECT_LT(j["excess"].get<double>(), 0.4);
  EXPECT_TRUE(read_text(block).find("tool: {xyz: [0, 0, 0], rpy: [0, -90, 0]}") != std::string::npos) << read_text(block);
}

TEST_F(ModelFit, GoesOnUntilItIsTightEnough) {
  const std::string mesh = scratch_.file("bend.stl", binary_stl(bent_pipe(0.2, 0.03, model::kPi / 2)));
  const Words words = Words{kModel, "fit", "--link", "0=" + mesh, "--model", "m", "--json"} + kKinematics;
  const Outcome o = run(words + Words{"--excess", "0.3"}, 60s);
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto j = nlohmann::json::parse(o.output).at(0);
  EXPECT_LE(j["excess"].get<double>(), 0.3);
  EXPECT_GT(j["capsules"].size(), 1U);
  const Outcome impossible = run(words + Words{"--excess", "0.3", "--capsules", "1"});
  EXPECT_EQ(impossible.exit_code, 2) << impossible;
  EXPECT_TRUE(impossible.says("--excess 0.3: not reached")) << impossible;
}

TEST_F(ModelFit, SaysWhatIsWrong) {
  const std::string mesh = scratch_.file("box.stl", binary_stl(box({0.1, 0.1, 0.1})));
  const auto fit = [&](const Words& words) { return run(Words{kModel, "fit", "--model", "m"} + words); };
  struct Wrong {
    Words words;
    std::string says;
  };
  Mesh nowhere = box({1, 1, 1});
  nowhere.vertices[0].x() = std::nan("");
  const std::string nan = scratch_.file("nan.stl", binary_stl(nowhere));
  const std::string empty = scratch_.file("empty.obj", "v 0 0 0\n");
  const std::vector<Wrong> all{
      {kKinematics, "no meshes"},
      {{"--link", "0=" + mesh}, "no kinematics"},
      {kKinematics + Words{"--link", "7=" + mesh}, "--link 7=" + mesh + ": expected N=MESH with a link N from 0 (base) to 6"},
      {kKinematics + Words{"--link", mesh}, "expected N=MESH"},
      {kKinematics + Words{"--link", "0=" + scratch_.path("no.stl")}, scratch_.path("no.stl") + ": no such file"},
      {kKinematics + Words{"--link", "0=" + nan}, nan + ": a coordinate is not a finite number"},
      {kKinematics + Words{"--link", "0=" + empty}, empty + ": "},
      {kKinematics + Words{"--link", "0=" + mesh, "--capsules", "0"}, "--capsules"},
      {kKinematics + Words{scratch_.path("no.yaml")}, scratch_.path("no.yaml") + ": no such file"},
      {{"--link", "0=" + mesh, "--opw", "0", "0", "0", "1", "0", "1", "1"}, "c2 and c3 > 0"},
      {{"--link", "0=" + mesh, "--opw", "0", "0", "nan", "1", "1", "1", "1"}, "within 1000 m"},
      {{"--link", "0=" + mesh, "--cell", deployed("exp-4-2/cell.yaml")}, "no robot has the model m"},
      {kKinematics + Words{"--link", "0=" + mesh, "--cell", deployed("exp-4-2/cell.yaml")}, "excludes"}};
  for (const Wrong& wrong : all) {
    const Outcome o = fit(wrong.words);
    EXPECT_EQ(o.exit_code, 2) << o;
    EXPECT_TRUE(o.says(wrong.says)) << wrong.says << "\n" << o;
    EXPECT_TRUE(o.output.empty()) << o;
  }
  EXPECT_TRUE(run({kModel, "fit", "--help"}).says("tightest capsules"));
  EXPECT_EQ(run({kModel}).exit_code, 2);
}

}  // namespace
}  // namespace interlace::test
