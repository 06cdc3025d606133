#pragma once

#include <string>

#include "common/model/robot_model.hpp"

namespace interlace::app {

/// `model` as the block `models` of a cell file in mm and deg (format: docs/files.md), from the line `models:` on. `comment` stands above
/// it, one `#` a line; may be empty. Numbers have 12 significant digits, so what `parse_cell` reads from it is the same model to within
/// 5e-12 of each number, and exactly the same where the numbers in the file are short. What is as it would be when left out is left out.
/// Pure; any thread.
[[nodiscard]] std::string model_text(const model::RobotModel& model, const std::string& comment = {});

}  // namespace interlace::app
