#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

namespace interlace::app {

enum class LogLevel { debug, info, warning, error };

/// One `key=value` of a log line.
struct LogField {
  LogField(std::string_view name, std::string_view text) : key(name), value(text) {}
  LogField(std::string_view name, const std::string& text) : key(name), value(text) {}
  LogField(std::string_view name, const char* text) : key(name), value(text) {}
  LogField(std::string_view name, bool truth) : key(name), value(truth ? "true" : "false") {}
  LogField(std::string_view name, double number);  ///< six significant digits
  template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
  LogField(std::string_view name, Integer number) : key(name), value(std::to_string(number)) {}

  std::string key;
  std::string value;
};

/// From now on events of at least `level` go to stderr, one line each: `2026-01-31T12:00:00.123456Z info planner dispatched robot=r1 …`.
/// Replaces spdlog's default logger. Call once, before other threads log.
void start_logging(const std::string& program, LogLevel level);

/// `debug`, `info`, `warning` or `error`, as the option --log takes them; throws std::invalid_argument otherwise.
[[nodiscard]] LogLevel parse_log_level(const std::string& text);

/// `event key=value …` on one line: a value that is empty or has blanks, quotes or control characters is quoted and escaped.
[[nodiscard]] std::string log_line(std::string_view event, std::initializer_list<LogField> fields);

/// Writes one event. Any thread.
void log(LogLevel level, std::string_view event, std::initializer_list<LogField> fields = {});

}  // namespace interlace::app
