#include "tests/model/walker.hpp"

#include <algorithm>
#include <utility>

namespace interlace::test {

namespace {

constexpr std::size_t kSamples = 50;

}  // namespace

Walker::Walker(const Scenario& scenario, std::size_t limit)
    : scenario_(scenario), limit_(limit), motions_(*scenario.cell), judge_(motions_) {}

Walk Walker::walk() {
  found_.interleavings = walk_from(World{scenario_, motions_, judge_});
  found_.states = seen_.size();
  return found_;
}

World Walker::replay(const std::vector<std::size_t>& numbers) {
  World world{scenario_, motions_, judge_};
  for (const std::size_t n : numbers) world.happen(world.choices().at(n));
  return world;
}

/// Interleavings from here on.
double Walker::walk_from(World world) {
  found_.depth = std::max(found_.depth, numbers_.size());
  found_.least = std::min(found_.least, world.least_clearance());
  if (!world.fault().empty()) return blame(world.fault()), 1;
  const auto [entry, fresh] = seen_.try_emplace(world.signature(), kOpen);
  double& interleavings = entry->second;
  if (!fresh) {
    ++found_.branches;
    // Time that passes and changes nothing will go on so for ever.
    if (interleavings == kOpen) blame("it goes round in a circle and never ends");
    return std::max(interleavings, 0.0);
  }
  if (numbers_.size() > kDeepest) return blame("it never ends"), 1;
  const std::vector<Choice> choices = world.choices();
  if (choices.empty()) return interleavings = end_at(world);
  double sum = 0;
  for (std::size_t n = 0; n < choices.size(); ++n) {
    if (!found_.fault.empty()) break;
    if (seen_.size() >= limit_) {
      found_.whole = false;
      break;
    }
    numbers_.push_back(n);
    told_.push_back(world.tell(choices[n]));
    World next = n + 1 < choices.size() ? world : std::move(world);
    next.happen(choices[n]);
    sum += walk_from(std::move(next));
    numbers_.pop_back();
    told_.pop_back();
  }
  return interleavings = sum;
}

double Walker::end_at(const World& world) {
  ++found_.branches;
  ++found_.ends;
  bool delayed = false, cancelled = false;
  std::size_t escapes = 0;
  for (const auto& [id, said] : world.said()) {
    const bool completed = said.newest.state == model::CommandState::completed;
    delayed = delayed || said.delayed;
    if (said.newest.escape && completed) ++escapes;
    if (!said.newest.escape && said.newest.state == model::CommandState::cancelled) cancelled = true;
  }
  found_.delays += delayed ? 1 : 0;
  found_.cancels += cancelled ? 1 : 0;
  found_.most_escapes = std::max(found_.most_escapes, escapes);
  if (found_.samples.size() < kSamples) {
    found_.samples.push_back(numbers_);
    found_.sample_ends.push_back(world.signature());
  }
  return 1;
}

void Walker::blame(const std::string& text) {
  if (!found_.fault.empty()) return;
  found_.fault = text + ", after:";
  for (const std::string& t : told_) found_.fault += "\n  " + t;
}

}  // namespace interlace::test
