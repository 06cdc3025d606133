#pragma once

#include <string>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"

namespace interlace::app::samples {

/// A cell file that uses every key once; tests break it one place at a time.
extern const std::string kCell;
/// A program file for it, likewise.
extern const std::string kProgram;

/// The cell file with tools, of which r1 holds one.
extern const std::string kToolCell;

/// `text` with the first occurrence of `from` replaced by `to`; throws when there is none, so that no test passes for nothing.
std::string replaced(const std::string& text, const std::string& from, const std::string& to);

/// The findings of a text that must be refused, for assertions; empty when it was accepted.
std::vector<Finding> cell_findings(const std::string& text);
std::vector<Finding> program_findings(const std::string& text);

/// One way to break a file, and the whole message expected for it, apart from the file name.
struct Broken {
  const char* name;
  std::string from;
  std::string to;
  int line;
  std::string key;
  std::string found;
  std::string rule;  ///< a part of it
};

/// Expects exactly the finding `broken` describes, as a value and as text.
void expect_only(const std::vector<Finding>& findings, const Broken& broken, const std::string& file);

}  // namespace interlace::app::samples
