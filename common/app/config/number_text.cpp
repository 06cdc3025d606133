#include "common/app/config/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace interlace::app {

std::string number_text(double value, double per_si) {
  constexpr double kNothing = 1e-10;
  const double shown = value * per_si;
  return fmt::format("{:.12g}", std::abs(shown) < kNothing ? 0.0 : shown);
}

std::string numbers_text(const Eigen::Ref<const Eigen::VectorXd>& values, double per_si) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i) text += (i > 0 ? ", " : "") + number_text(values[i], per_si);
  return text;
}

}  // namespace interlace::app
