#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulator/reproduce/svg.hpp"

namespace interlace::reproduce {

/// Colours that colour-blind people tell apart (Okabe and Ito 2008).
inline constexpr const char* kBlue = "#0072b2";
inline constexpr const char* kVermilion = "#d55e00";
inline constexpr const char* kInk = "#222222";
inline constexpr const char* kGrid = "#e3e3e3";

/// Light enough for black letters on it; one per robot, from the first again after the last.
[[nodiscard]] const char* robot_colour(std::size_t robot);

/// Round values in [low, high], about `wanted` of them.
[[nodiscard]] std::vector<double> ticks(double low, double high, int wanted);

/// A rectangle of a picture with a value range on each side.
struct Axes {
  double left = 0, top = 0, width = 0, height = 0;  ///< [px]
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;            ///< values at its sides

  [[nodiscard]] double x(double value) const { return left + (value - x0) / (x1 - x0) * width; }
  [[nodiscard]] double y(double value) const { return top + height - (value - y0) / (y1 - y0) * height; }
  [[nodiscard]] Point at(double vx, double vy) const { return {x(vx), y(vy)}; }
};

/// Grid lines with values along the bottom and, unless `wanted` is 0, along the left side.
struct Grid {
  int x_ticks = 10, y_ticks = 5;  ///< about how many; 0: none
  bool x_values = true, y_values = true;
  double size = 11;  ///< of the values [px]
};
void draw_grid(Svg& svg, const Axes& axes, const Grid& grid);

/// The frame around the axes.
void draw_frame(Svg& svg, const Axes& axes);

}  // namespace interlace::reproduce
