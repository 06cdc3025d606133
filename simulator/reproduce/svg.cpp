#include "simulator/reproduce/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace interlace::reproduce {

namespace {

std::string attributes(const Style& s) {
  std::string text;
  if (!s.name.empty()) text += fmt::format(" class=\"{}\"", escaped(s.name));
  text += fmt::format(" fill=\"{}\"", escaped(s.fill));
  if (s.stroke != "none") text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", escaped(s.stroke), number(s.width));
  if (!s.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", escaped(s.dash));
  return text;
}

/// Distance of `p` from the line through `a` and `b` [px].
double off_line(const Point& p, const Point& a, const Point& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) out += c;  // XML 1.0 has no place for control characters
    }
  }
  return out;
}

std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::vector<Point> simplified(const std::vector<Point>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double most = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = off_line(points[i], points[first], points[last]);
      if (d > most) {
        most = d;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) result.push_back(points[i]);
  }
  return result;
}

Svg::Svg(double width, double height, std::string_view title) {
  body_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<title>{2}</title>\n",
      number(width), number(height), escaped(title));
  rect(0, 0, width, height, {"#ffffff"});
}

void Svg::rect(double x, double y, double width, double height, const Style& style, std::string_view hint) {
  const std::string shape = fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}", number(x), number(y), number(width),
                                        number(height), attributes(style));
  body_ += hint.empty() ? shape + "/>\n" : fmt::format("{}><title>{}</title></rect>\n", shape, escaped(hint));
}

void Svg::line(Point from, Point to, const Style& style) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", number(from.x), number(from.y), number(to.x), number(to.y),
                       attributes(style));
}

void Svg::polyline(const std::vector<Point>& points, const Style& style) {
  std::string list;
  for (const Point& p : points) {
    fmt::format_to(std::back_inserter(list), "{}{},{}", list.empty() ? "" : " ", number(p.x), number(p.y));
  }
  body_ += fmt::format("<polyline points=\"{}\"{} stroke-linejoin=\"round\"/>\n", list, attributes(style));
}

void Svg::path(std::string_view commands, const Style& style) {
  body_ += fmt::format("<path d=\"{}\"{}/>\n", escaped(commands), attributes(style));
}

void Svg::text(Point at, std::string_view text, const TextStyle& s) {
  const char* anchor = s.anchor == Anchor::start ? "start" : s.anchor == Anchor::middle ? "middle" : "end";
  body_ += fmt::format("<text x=\"{0}\" y=\"{1}\" font-size=\"{2}\" fill=\"{3}\" text-anchor=\"{4}\"{5}{6}>{7}</text>\n", number(at.x),
                       number(at.y), number(s.size), escaped(s.colour), anchor, s.bold ? " font-weight=\"bold\"" : "",
                       s.upwards ? fmt::format(" transform=\"rotate(-90 {} {})\"", number(at.x), number(at.y)) : "", escaped(text));
}

void Svg::hatching(std::string_view id, std::string_view colour) {
  body_ += fmt::format(
      "<defs><pattern id=\"{}\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
      "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"5\" stroke=\"{}\" stroke-width=\"2\"/></pattern></defs>\n",
      escaped(id), escaped(colour));
}

void Svg::begin_clip(double x, double y, double width, double height) {
  ++clips_;
  body_ += fmt::format(
      "<clipPath id=\"clip{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n<g clip-path=\"url(#clip{0})\">\n",
      clips_, number(x), number(y), number(width), number(height));
}

void Svg::end_clip() {
  body_ += "</g>\n";
}

std::string Svg::str() const {
  return body_ + "</svg>\n";
}

}  // namespace interlace::reproduce
