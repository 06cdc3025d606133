#include "modeller/fit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/field.hpp"
#include "common/app/config/model_section.hpp"
#include "common/app/config/model_text.hpp"
#include "modeller/fitted_shape.hpp"
#include "modeller/shapes_file.hpp"

namespace interlace::modeller {

namespace {

using app::ExitCode;

ExitCode refuse(const std::string& message) {
  fmt::print(stderr, "{}\n", message);
  return ExitCode::bad_input;
}

/// Metres in one unit of the command line.
double scale_of(const FitArguments& a) {
  return a.units == "m" ? 1 : 0.001;
}

model::Result<Shape, std::string> shape_of(const std::string& word, double scale) {
  Shape shape;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), shape.link);
  const std::size_t at = static_cast<std::size_t>(end - word.data());
  if (error != std::errc{} || shape.link > model::kJoints || at + 1 >= word.size() || word[at] != '=') {
    return model::unexpected{fmt::format("--link {}: expected N=MESH with a link N from 0 (base) to 6 (flange)", word)};
  }
  shape.file = word.substr(at + 1);
  shape.scale = scale;
  return shape;
}

model::Result<std::vector<Shape>, std::string> shapes_of(const FitArguments& a) {
  std::vector<Shape> shapes;
  if (!a.shapes.empty()) {
    auto loaded = load_shapes(a.shapes);
    if (!loaded) return model::unexpected{to_string(loaded.error())};
    shapes = std::move(*loaded);
  }
  for (const std::string& word : a.links) {
    auto shape = shape_of(word, scale_of(a));
    if (!shape) return model::unexpected{shape.error()};
    shapes.push_back(std::move(*shape));
  }
  if (shapes.empty()) return model::unexpected{std::string{"no meshes: name a file that lists them, or give them with --link N=MESH"}};
  return shapes;
}

/// False when these lengths are none of an arm; the rules are those of a cell file.
bool read_opw(const FitArguments& a, model::OpwParameters& p) {
  constexpr double kFarthest = 1000;  // [m]
  double* const lengths[]{&p.a1, &p.a2, &p.b, &p.c1, &p.c2, &p.c3, &p.c4};
  bool good = true;
  for (std::size_t i = 0; i < std::size(lengths); ++i) {
    *lengths[i] = scale_of(a) * a.opw[i];
    good = good && std::abs(*lengths[i]) <= kFarthest;
  }
  return good && p.c1 >= 0 && p.c2 > 0 && p.c3 > 0 && p.c4 >= 0;
}

/// Everything of the model but its capsules.
model::Result<model::RobotModel, std::string> frame_of(const FitArguments& a) {
  if (!model::is_valid_name(a.model)) {
    return model::unexpected{fmt::format("--model {}: expected 1 to 64 letters, digits, '_', '-', '.' or ':'", a.model)};
  }
  if (!a.cell.empty()) {
    const auto loaded = app::load_cell(a.cell);
    if (!loaded) return model::unexpected{to_string(loaded.error())};
    std::vector<std::string> names;
    for (const auto& robot : loaded->cell.robots) {
      if (robot.model.name == a.model) return robot.model;
      names.push_back(robot.model.name);
    }
    return model::unexpected{fmt::format("{}: no robot has the model {}{}", a.cell, a.model, app::did_you_mean(a.model, names))};
  }
  if (a.opw.empty()) {
    return model::unexpected{std::string{"no kinematics: take them from a cell file with --cell, or give them with --opw"}};
  }
  model::OpwParameters p;
  if (!read_opw(a, p)) {
    return model::unexpected{fmt::format("--opw {}: expected lengths within 1000 m, c1 and c4 >= 0, c2 and c3 > 0", fmt::join(a.opw, " "))};
  }
  for (std::size_t i = 0; i < a.offsets.size(); ++i) p.offsets[i] = a.offsets[i] * model::kPi / 180;
  std::copy(a.signs.begin(), a.signs.end(), p.signs.begin());
  model::RobotModel frame;
  frame.name = a.model;
  frame.kinematics = model::Kinematics{p};
  return frame;
}

model::Result<std::vector<FittedShape>, std::string> fit_all(const std::vector<Shape>& shapes, const FitArguments& a) {
  CoverOptions options;
  options.excess = a.excess;
  options.capsules = a.capsules > 0 ? a.capsules : (a.excess ? kMostCapsules : 1);
  std::vector<FittedShape> all;
  for (const Shape& shape : shapes) {
    auto fitted = fit(shape, options);
    if (!fitted) return model::unexpected{to_string(fitted.error())};
    if (a.excess && !(fitted->cover.excess() <= *a.excess)) {
      return model::unexpected{
          fmt::format("{}\n--excess {}: not reached with these capsules, and another one would not help or is not allowed",
                      describe(*fitted), *a.excess)};
    }
    all.push_back(std::move(*fitted));
  }
  return all;
}

/// "1, 4": links that none of the shapes belongs to.
std::string bare_links(const std::vector<FittedShape>& all) {
  std::vector<std::size_t> bare;
  for (std::size_t link = 0; link <= model::kJoints; ++link) {
    if (std::none_of(all.begin(), all.end(), [&](const FittedShape& f) { return f.shape.link == link; })) bare.push_back(link);
  }
  return fmt::format("{}", fmt::join(bare, ", "));
}

}  // namespace

void add_fit(CLI::App& cli, FitArguments& a) {
  CLI::App* fit = cli.add_subcommand(
      "fit",
      "Fits the tightest capsules to the meshes of an arm's links and prints the block `models` of a cell file. Every vertex of a mesh\n"
      "lies inside, so the whole surface does; how tight they are is told in the comments. Meshes are STL or OBJ files, listed in a\n"
      "file with the place each has in its link's frame, or given one by one when that place is the frame itself.\n\n"
      "  interlace-model fit arm/shapes.yaml --model arm6 --opw 0 -70 0 290 270 302 72 --offsets 0 0 -90 0 0 0\n"
      "  interlace-model fit --link 0=base.stl --link 2=upper.stl --capsules 3 --model arm6 --cell cell.yaml\n\n"
      "docs/models.md tells more.");
  fit->add_option("SHAPES", a.shapes, "file that lists the meshes of the links");
  fit->add_option("--link", a.links, "N=MESH: a mesh in the frame of link N, 0 (base) to 6 (flange); may be repeated")
      ->allow_extra_args(false);
  fit->add_option("--units", a.units, "of the lengths in the meshes of --link and in --opw")
      ->check(CLI::IsMember({"mm", "m"}))
      ->capture_default_str();
  fit->add_option("--capsules", a.capsules, "for each mesh at most; default: 1, with --excess as many as that takes")
      ->check(CLI::Range(std::size_t{1}, kMostCapsules));
  fit->add_option("--excess", a.excess, "go on until the capsules take at most this share more volume than the mesh (0.5 = 50 %)")
      ->check(CLI::Range(0.0, 1e3));
  fit->add_option("--model", a.model, "name of the model")->required();
  auto* cell = fit->add_option("--cell", a.cell, "cell file with a robot of that model: its kinematics, joints and tool are taken");
  auto* opw =
      fit->add_option("--opw", a.opw, "kinematics instead: a1 a2 b c1 c2 c3 c4")->expected(7)->allow_extra_args(false)->excludes(cell);
  fit->add_option("--offsets", a.offsets, "with --opw: the joints' offsets in degrees")->expected(6)->allow_extra_args(false)->needs(opw);
  fit->add_option("--signs", a.signs, "with --opw: the joints' signs, 1 or -1")
      ->expected(6)
      ->allow_extra_args(false)
      ->needs(opw)
      ->check(CLI::IsMember({1, -1}));
  fit->add_option("--output", a.output, "write the block to this file, and print only how well the capsules fit");
  fit->add_flag("--json", a.json, "print how well the capsules fit, and the capsules, as JSON");
}

ExitCode run_fit(const FitArguments& a) {
  auto frame = frame_of(a);
  if (!frame) return refuse(frame.error());
  const auto shapes = shapes_of(a);
  if (!shapes) return refuse(shapes.error());
  const auto fitted = fit_all(*shapes, a);
  if (!fitted) return refuse(fitted.error());

  frame->capsules = link_capsules(*fitted);
  frame->self_pairs = model::default_self_pairs(frame->capsules);
  if (frame->capsules.size() > app::kMaxCapsules) {
    return refuse(fmt::format("{} capsules: a model has at most {}", frame->capsules.size(), app::kMaxCapsules));
  }
  std::string lines;
  auto json = nlohmann::json::array();
  for (const FittedShape& f : *fitted) {
    lines += describe(f) + '\n';
    json.push_back(to_json(f));
  }
  if (const std::string bare = bare_links(*fitted); !bare.empty()) {
    fmt::print(stderr, "warning: no mesh for links {}: nothing will keep clear of them\n", bare);
    lines += fmt::format("no mesh for links {}: nothing keeps clear of them\n", bare);
  }
  const std::string block = app::model_text(*frame, "Fitted by interlace-model.\n" + lines);
  if (!a.output.empty()) {
    std::ofstream out{a.output};
    out << block;
    out.close();
    if (!out) return refuse(fmt::format("{}: cannot be written", a.output));
  }
  std::cout << (a.json ? json.dump(2) + '\n' : (a.output.empty() ? block : lines)) << std::flush;
  return std::cout ? ExitCode::ok : ExitCode::fault;
}

}  // namespace interlace::modeller
