#pragma once

#include <Eigen/Core>
#include <string>

namespace interlace::app {

/// `value` (SI) in a file's units, `per_si` of them making one: 12 significant digits; what they cannot tell from zero is zero, and zero
/// has no sign.
[[nodiscard]] std::string number_text(double value, double per_si);

/// The same for several, with commas between them.
[[nodiscard]] std::string numbers_text(const Eigen::Ref<const Eigen::VectorXd>& values, double per_si);

}  // namespace interlace::app
