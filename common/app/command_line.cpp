#include "common/app/command_line.hpp"

#include <map>

namespace interlace::app {

const char* version() {
  return INTERLACE_VERSION;
}

void add_common(CLI::App& app) {
  app.set_version_flag("--version", version());
  app.footer(exit_code_help());
}

CLI::Option* add_domain(CLI::App& app, int& domain) {
  return app.add_option("--domain", domain, "DDS domain")
      ->check(CLI::Range(0, kMaxDomain))
      ->envname("INTERLACE_DOMAIN")
      ->capture_default_str();
}

CLI::Option* add_log_level(CLI::App& app, LogLevel& level) {
  return app
      .add_option_function<std::string>(
          "--log", [&level](const std::string& text) { level = parse_log_level(text); }, "Least level that is logged")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
      ->default_str("info");
}

std::optional<ExitCode> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::ok : ExitCode::bad_input;
  }
}

}  // namespace interlace::app
