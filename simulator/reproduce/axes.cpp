#include "simulator/reproduce/axes.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace interlace::reproduce {

const char* robot_colour(std::size_t robot) {
  static constexpr std::array<const char*, 4> kColours{"#8cc4e8", "#f2c36b", "#7fd1b4", "#e3b1cc"};
  return kColours[robot % kColours.size()];
}

std::vector<double> ticks(double low, double high, int wanted) {
  if (wanted <= 0 || !(high > low)) return {};
  const double rough = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double candidate : {1.0, 2.0, 5.0}) {
    if (candidate * power >= rough * (1 - 1e-9)) {
      step = candidate * power;
      break;
    }
  }
  std::vector<double> values;
  for (auto i = static_cast<long>(std::ceil(low / step - 1e-9)); static_cast<double>(i) * step <= high + 1e-9 * step; ++i)
    values.push_back(static_cast<double>(i) * step);
  return values;
}

void draw_grid(Svg& svg, const Axes& axes, const Grid& grid) {
  Style line;
  line.stroke = kGrid;
  TextStyle below;
  below.size = grid.size;
  below.anchor = Anchor::middle;
  for (const double value : ticks(axes.x0, axes.x1, grid.x_ticks)) {
    svg.line({axes.x(value), axes.top}, {axes.x(value), axes.top + axes.height}, line);
    if (grid.x_values) svg.text({axes.x(value), axes.top + axes.height + grid.size + 4}, number(value), below);
  }
  TextStyle beside = below;
  beside.anchor = Anchor::end;
  for (const double value : ticks(axes.y0, axes.y1, grid.y_ticks)) {
    svg.line({axes.left, axes.y(value)}, {axes.left + axes.width, axes.y(value)}, line);
    if (grid.y_values) svg.text({axes.left - 5, axes.y(value) + grid.size / 3}, number(value), beside);
  }
}

void draw_frame(Svg& svg, const Axes& axes) {
  Style frame;
  frame.stroke = "#888888";
  svg.rect(axes.left, axes.top, axes.width, axes.height, frame);
}

}  // namespace interlace::reproduce
