#pragma once

#include <string>

#include "common/model/program.hpp"

namespace interlace::app {

/// `program` as the text of a program file in mm and deg (format: docs/files.md), without `repeat`. `comment` stands above it, one `#` a
/// line; may be empty. Numbers have 12 significant digits, so what `parse_program` reads from it is the same program to within 1e-12 of
/// each number, and exactly the same where the numbers in the file are short, as a generator's are. Robots without commands are left out.
/// Pure; any thread.
[[nodiscard]] std::string program_text(const model::Program& program, const std::string& comment = {});

}  // namespace interlace::app
