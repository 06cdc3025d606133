#include "monitor/server/access.hpp"

#include <algorithm>
#include <cctype>

namespace interlace::monitor {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Without the port.
std::string name_of(const std::string& host) {
  const auto bracket = host.find(']');
  const auto colon = host.find(':', bracket == std::string::npos ? 0 : bracket);
  return lower(host.substr(0, colon));
}

bool of_this_machine(const std::string& host) {
  const std::string name = name_of(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

}  // namespace

Refusal judge(const RequestHead& head, bool loopback) {
  if (head.method != "GET" && head.method != "HEAD") return {405, "only GET and HEAD are served"};
  if (head.target.size() > kMaxTarget) return {414, "the target is too long"};
  if (head.target.empty() || head.target.front() != '/') return {400, "the target is not a path"};
  if (head.host.empty()) return {400, "there is no Host"};
  if (loopback && !of_this_machine(head.host)) return {403, "only this machine is served, under its own name"};
  if (!head.origin.empty() && lower(head.origin) != "http://" + lower(head.host)) return {403, "pages of other sites are not let in"};
  const bool live = head.target == kLivePath;
  if (live && !head.upgrade) return {426, "this is a WebSocket"};
  if (!live && head.upgrade) return {404, "there is no such WebSocket"};
  return {};
}

const std::vector<std::pair<std::string_view, std::string_view>>& security_headers() {
  static const std::vector<std::pair<std::string_view, std::string_view>> headers{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; base-uri 'none'; "
       "form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"}};
  return headers;
}

}  // namespace interlace::monitor
