#include "simulator/reproduce/command_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/reproduce/axes.hpp"

namespace interlace::reproduce {

namespace {

constexpr double kWidth = 1060, kLeft = 44, kRight = 16, kTop = 58, kRow = 50, kBox = 28, kBottom = 44;
constexpr double kShown = 0.02;   // shorter waits are no more than a line [s]
constexpr double kLetter = 0.62;  // width of a digit or capital by its height

class Chart {
 public:
  Chart(const std::string& title, const app::RunReport& report, const model::Cell& cell, const NamedCommands& named, double end)
      : report_(report), cell_(cell), named_(named), svg_(kWidth, kTop + kRow * static_cast<double>(cell.robots.size()) + kBottom, title) {
    axes_.left = kLeft;
    axes_.top = kTop;
    axes_.width = kWidth - kLeft - kRight;
    axes_.height = kRow * static_cast<double>(cell.robots.size());
    axes_.x1 = std::max(end, 1.0);
    TextStyle heading;
    heading.size = 14;
    heading.bold = true;
    svg_.text({kLeft, 20}, title, heading);
  }

  std::string draw() {
    svg_.hatching("wait", "#999999");
    legend();
    Grid grid;
    grid.x_ticks = 12;
    grid.y_ticks = 0;
    draw_grid(svg_, axes_, grid);
    for (model::RobotIndex i = 0; i < cell_.robots.size(); ++i) row(i);
    draw_frame(svg_, axes_);
    TextStyle unit;
    unit.anchor = Anchor::middle;
    svg_.text({axes_.left + axes_.width / 2, axes_.top + axes_.height + 36}, "time after the start of the program [s]", unit);
    return svg_.str();
  }

 private:
  void legend() {
    const double y = 31;
    Style command{robot_colour(0), kInk};
    svg_.rect(kLeft, y, 26, 14, command);
    svg_.text({kLeft + 32, y + 11}, "command (colour: robot)");
    svg_.rect(kLeft + 215, y + 3, 26, 8, waiting("legend"));
    svg_.text({kLeft + 247, y + 11}, "waits for others");
    svg_.rect(kLeft + 385, y, 26, 14, {"#000000", "#000000"});
    svg_.text({kLeft + 417, y + 11}, "escape");
  }

  static Style waiting(const std::string& name) {
    Style s{"url(#wait)", "#777777"};
    s.width = 0.6;
    s.name = name;
    return s;
  }

  void row(model::RobotIndex robot) {
    const double middle = kTop + kRow * (static_cast<double>(robot) + 0.5);
    TextStyle name;
    name.anchor = Anchor::end;
    name.bold = true;
    svg_.text({kLeft - 6, middle + 4}, cell_.robots[robot].name.str(), name);

    std::vector<const app::CommandRow*> rows;
    for (const app::CommandRow& r : report_.commands) {
      if (r.robot == cell_.robots[robot].name) rows.push_back(&r);
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto* a, const auto* b) { return a->start.value_or(1e300) < b->start.value_or(1e300); });
    double free_from = 0;  // [s]
    for (const app::CommandRow* r : rows) {
      if (!r->start) {
        if (model::is_final(r->state)) continue;  // rejected or cancelled: it waits for nothing
        wait(std::max(free_from, r->release), axes_.x1, middle);
        TextStyle note;
        note.anchor = Anchor::end;
        note.size = 11;
        svg_.text({axes_.left + axes_.width - 4, middle - 8}, label(*r) + " never starts", note);
        break;
      }
      wait(std::max(free_from, r->release), *r->start, middle);
      free_from = r->end.value_or(axes_.x1);
      box(*r, robot, middle);
    }
  }

  void wait(double from, double until, double middle) {
    if (until - from < kShown) return;
    svg_.rect(axes_.x(from), middle - 6, axes_.x(until) - axes_.x(from), 12, waiting("waiting"));
  }

  void box(const app::CommandRow& r, model::RobotIndex robot, double middle) {
    const double left = axes_.x(*r.start);
    const double width = std::max(1.0, axes_.x(r.end.value_or(axes_.x1)) - left);
    Style style{r.escape ? "#000000" : robot_colour(robot), kInk};
    style.width = 0.8;
    style.name = r.escape ? "escape" : "command";
    const std::string text = label(r);
    svg_.rect(left, middle - kBox / 2, width, kBox, style,
              fmt::format("{} {}: {:.2f} to {:.2f} s, delayed {:.2f} s{}{}", text, r.id.str(), *r.start, r.end.value_or(axes_.x1), r.delay,
                          r.explanation.empty() ? "" : "; ", r.explanation));
    if (r.escape) return;
    TextStyle inside;
    inside.anchor = Anchor::middle;
    for (const double size : {12.0, 10.0, 8.5}) {
      inside.size = size;
      if (kLetter * size * static_cast<double>(text.size()) > width - 2) continue;
      svg_.text({left + width / 2, middle + size * 0.36}, text, inside);
      return;
    }
    inside.size = 9;  // above a box that is too narrow for it
    svg_.text({left + width / 2, middle - kBox / 2 - 2}, text, inside);
  }

  [[nodiscard]] std::string label(const app::CommandRow& r) const {
    const auto found = named_.find(r.id);
    return found == named_.end() ? (r.escape ? "escape" : r.id.str()) : found->second.label;
  }

  const app::RunReport& report_;
  const model::Cell& cell_;
  const NamedCommands& named_;
  Svg svg_;
  Axes axes_;
};

}  // namespace

double last_end(const app::RunReport& report) {
  double last = 0;
  for (const app::CommandRow& r : report.commands) last = std::max({last, r.end.value_or(0), r.start.value_or(0), r.release});
  return last;
}

std::string command_chart(const std::string& title, const app::RunReport& report, const model::Cell& cell, const NamedCommands& named,
                          double end) {
  return Chart{title, report, cell, named, end}.draw();
}

}  // namespace interlace::reproduce
