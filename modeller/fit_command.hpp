#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/app/exit_code.hpp"

namespace interlace::modeller {

/// What `interlace-model fit` is asked for.
struct FitArguments {
  std::string shapes, units = "mm";
  std::vector<std::string> links;  ///< N=MESH
  std::string model, cell, output;
  std::vector<double> opw;      ///< none, or a1 a2 b c1 c2 c3 c4, in `units`
  std::vector<double> offsets;  ///< none, or six [deg]
  std::vector<int> signs;       ///< none, or six
  std::size_t capsules = 0;     ///< for each mesh at most; 0: as the others say
  std::optional<double> excess;
  bool json = false;
};

/// Adds the subcommand to `cli`; `a` must live until it has been parsed.
void add_fit(CLI::App& cli, FitArguments& a);

/// Does it: prints the block of the cell file, and what is wrong to stderr.
[[nodiscard]] app::ExitCode run_fit(const FitArguments& a);

}  // namespace interlace::modeller
