#include "common/model/time_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace interlace::model {

TimeLaw::TimeLaw(double distance, double velocity, double acceleration) : distance_(distance), acceleration_(acceleration) {
  if (!(distance >= 0) || !(velocity > 0) || !(acceleration > 0)) {
    throw std::invalid_argument("a time law needs distance ≥ 0, velocity > 0 and acceleration > 0");
  }
  if (distance < velocity * velocity / acceleration) {
    ramp_ = std::sqrt(distance / acceleration);
    duration_ = 2 * ramp_;
  } else {
    ramp_ = velocity / acceleration;
    duration_ = distance / velocity + ramp_;
  }
}

TimeLaw TimeLaw::stretched_to(double duration) const {
  if (duration < duration_) throw std::invalid_argument("a time law can be stretched, not shortened");
  if (distance_ == 0) {
    TimeLaw still;
    still.duration_ = duration;
    return still;
  }
  TimeLaw longer = *this;
  const double factor = duration / duration_;
  longer.acceleration_ = acceleration_ / (factor * factor);
  longer.ramp_ = ramp_ * factor;
  longer.duration_ = duration;
  return longer;
}

double TimeLaw::at(double t) const {
  if (t <= 0 || distance_ == 0) return 0;
  if (t >= duration_) return distance_;
  if (t < ramp_) return 0.5 * acceleration_ * t * t;
  const double left = duration_ - t;
  if (left < ramp_) return distance_ - 0.5 * acceleration_ * left * left;
  return acceleration_ * ramp_ * (t - 0.5 * ramp_);
}

double TimeLaw::speed(double t) const {
  if (t <= 0 || t >= duration_) return 0;
  return acceleration_ * std::min({t, ramp_, duration_ - t});
}

}  // namespace interlace::model
