#pragma once

#include <string>
#include <vector>

namespace interlace::test {

/// What of the cell of experiment 4.2 a test wants otherwise. It moves five times as fast, so that a run takes seconds.
struct CellText {
  std::string name = "fast";
  double velocity = 500;       ///< of both TCPs [mm/s]
  double acceleration = 2000;  ///< [mm/s²]
  std::string controller;      ///< of both robots, such as "{start_latency: 0.02}"; empty: ideal
  std::string strategy = "event";
  std::string r2_start = "xyz: [450, -250, 300], rpy: [0, 0, 0]";
  std::string r2_joints;  ///< limits of its joints alone, such as "{min: [...], max: [...]}"; empty: as those of r1
  bool escapes = true;
  std::string fixtures;  ///< the entries of the list, one a line; empty: none
};

/// The cell file.
[[nodiscard]] std::string cell_text(const CellText& cell = {});

/// A linear command to (x, y, z) [mm] with the tool turned as at the start.
[[nodiscard]] std::string linear(double x, double y, double z);

/// The program file: commands of r1 and of r2, `repeat` times.
[[nodiscard]] std::string program_text(const std::vector<std::string>& r1, const std::vector<std::string>& r2, int repeat = 1);

/// Table 4.4 of the dissertation: two arms that go to the middle between them and past each other; 4 commands each.
[[nodiscard]] std::string table_4_4(int repeat = 1);

}  // namespace interlace::test
