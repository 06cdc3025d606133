#pragma once

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"

/// The deployed cells, for tests of what runs on them.
namespace interlace::test {

inline std::string deployed(const std::string& path) {
  return std::string{INTERLACE_CELLS_DIR} + "/" + path;
}

inline std::shared_ptr<const model::Cell> deployed_cell(const std::string& name) {
  auto loaded = app::load_cell(deployed(name + "/cell.yaml"));
  if (!loaded) throw std::runtime_error(to_string(loaded.error()));
  return std::make_shared<const model::Cell>(std::move(loaded->cell));
}

inline std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

}  // namespace interlace::test
