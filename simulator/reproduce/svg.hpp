#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace interlace::reproduce {

/// A point of a picture [px], y downwards.
struct Point {
  double x = 0, y = 0;
};

/// How a shape looks. `name` becomes its class: for tests and for style sheets of whoever embeds the picture.
struct Style {
  std::string fill = "none", stroke = "none";
  double width = 1;    ///< of the stroke [px]
  std::string dash{};  ///< pattern such as "4 3"; empty: solid
  std::string name{};
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 12;  ///< [px]
  Anchor anchor = Anchor::start;
  bool bold = false;
  bool upwards = false;  ///< turned by 90° to read from below
  std::string colour = "#222222";
};

/// `text` with the characters that mean something in XML replaced, and control characters left out.
[[nodiscard]] std::string escaped(std::string_view text);

/// Coordinates with at most two decimals: the same bytes for the same picture.
[[nodiscard]] std::string number(double value);

/// `points` without those that lie nearer than `tolerance` [px] to the line through the ones kept (Douglas and Peucker 1973).
[[nodiscard]] std::vector<Point> simplified(const std::vector<Point>& points, double tolerance);

/// Writes one SVG picture, shape after shape, on a white background so that it can be read on light and dark pages.
class Svg {
 public:
  /// Size [px]; `title` says in words what the picture shows, for those who cannot see it.
  Svg(double width, double height, std::string_view title);

  /// `hint` is what a pointer resting on the shape reads; may be empty.
  void rect(double x, double y, double width, double height, const Style& style, std::string_view hint = {});
  void line(Point from, Point to, const Style& style);
  void polyline(const std::vector<Point>& points, const Style& style);

  /// A shape from SVG path commands.
  void path(std::string_view commands, const Style& style);
  void text(Point at, std::string_view text, const TextStyle& style = {});

  /// Defines a hatching in `colour`; use it as fill "url(#id)".
  void hatching(std::string_view id, std::string_view colour);

  /// What is drawn from here to the next `end_clip` shows only inside the rectangle.
  void begin_clip(double x, double y, double width, double height);
  void end_clip();

  /// The whole document.
  [[nodiscard]] std::string str() const;

 private:
  std::string body_;
  int clips_ = 0;
};

}  // namespace interlace::reproduce
