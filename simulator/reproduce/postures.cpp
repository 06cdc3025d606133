#include "simulator/reproduce/postures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace interlace::reproduce {

namespace {

constexpr std::size_t kFirstJoint = 9;  // columns of the trace: t, robot, x, y, z, qw, qx, qy, qz, j1 … j6, motion

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::size_t from = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', from)) {
    result.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  result.push_back(line.substr(from));
  return result;
}

double to_double(const std::string& text, std::size_t line) {
  try {
    return std::stod(text);
  } catch (const std::exception&) {
    throw std::runtime_error{fmt::format("trace:{}: found \"{}\", expected a number", line, text)};
  }
}

}  // namespace

std::vector<Frame> parse_trace(const std::string& csv, const model::Cell& cell) {
  std::istringstream in{csv};
  std::string text;
  std::getline(in, text);  // header
  std::vector<Frame> frames;
  std::size_t robot = 0;
  for (std::size_t line = 2; std::getline(in, text); ++line) {
    const auto row = fields(text);
    if (row.size() != kFirstJoint + model::kJoints + 1)
      throw std::runtime_error{fmt::format("trace:{}: found {} columns, expected {}", line, row.size(), kFirstJoint + model::kJoints + 1)};
    if (row[1] != cell.robots[robot].name.str())
      throw std::runtime_error{fmt::format("trace:{}: found robot \"{}\", expected {}", line, row[1], cell.robots[robot].name.str())};
    if (robot == 0) frames.push_back({to_double(row[0], line), std::vector<model::Joints>(cell.robots.size())});
    for (std::size_t j = 0; j < model::kJoints; ++j)
      frames.back().joints[robot][static_cast<Eigen::Index>(j)] = to_double(row[kFirstJoint + j], line);
    robot = (robot + 1) % cell.robots.size();
  }
  return frames;
}

const Frame& frame_at(const std::vector<Frame>& frames, double t) {
  const auto after = std::upper_bound(frames.begin(), frames.end(), t, [](double value, const Frame& f) { return value < f.t; });
  return after == frames.begin() ? *after : *std::prev(after);
}

}  // namespace interlace::reproduce
