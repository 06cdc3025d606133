#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "common/app/command_line.hpp"
#include "common/app/config/cell_file.hpp"
#include "common/app/config/document.hpp"
#include "common/app/config/program_text.hpp"
#include "common/app/guarded_main.hpp"
#include "simulator/generator.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::string cell, output;
  sim::GeneratorOptions options;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Makes a random program for a cell and prints it as a program file. The program is well-formed: every command can be carried out\n"
      "while all other robots are home, ends clear of their homes, and leaves its robot a way home. So a planner that waits and makes\n"
      "robots give way can serve all of it. The same cell and seed give the same program.\n\n"
      "  interlace-generate deploy/cells/pattern-serial-3/cell.yaml --seed 7 --output /tmp/program.yaml\n"
      "  interlace-sim deploy/cells/pattern-serial-3/cell.yaml /tmp/program.yaml"};
  cli.add_option("CELL", a.cell, "cell file (deploy/cells/*/cell.yaml)")->required();
  cli.add_option("--seed", a.options.seed, "of the random numbers: another one, another program")->capture_default_str();
  cli.add_option("--commands", a.options.per_robot, "for each robot")->check(CLI::Range(1, 1000))->capture_default_str();
  cli.add_option("--shared", a.options.shared, "share of targets that another robot reaches too, 0 to 1")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  cli.add_option("--joint-moves", a.options.joint_moves, "share of joint moves, 0 to 1; none for models without joint speeds")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  cli.add_option("--output", a.output, "write to this file instead of printing");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

ExitCode run(const Arguments& a) {
  const auto loaded = app::load_cell(a.cell);
  if (!loaded) {
    fmt::print(stderr, "{}\n", to_string(loaded.error()));
    return ExitCode::bad_input;
  }
  const auto program = sim::generate_program(loaded->cell, a.options);
  if (!program) {
    fmt::print(stderr, "{}: {}\n", a.cell, program.error());
    return ExitCode::bad_input;
  }
  const std::string text =
      app::program_text(*program, fmt::format("Made by interlace-generate for cell {}: seed {}, {} commands for each robot.",
                                              loaded->cell.name, a.options.seed, a.options.per_robot));
  if (text.size() > app::kMaxFileSize) {
    fmt::print(stderr, "--commands: {} for each of {} robots make a file of {} KiB, at most {} KiB are read\n", a.options.per_robot,
               loaded->cell.robots.size(), text.size() / 1024, app::kMaxFileSize / 1024);
    return ExitCode::bad_input;
  }
  if (a.output.empty()) {
    std::cout << text << std::flush;
    return std::cout ? ExitCode::ok : ExitCode::fault;
  }
  std::ofstream out{a.output};
  out << text;
  out.close();
  if (!out) fmt::print(stderr, "{}: cannot be written\n", a.output);
  return out ? ExitCode::ok : ExitCode::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-generate", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
