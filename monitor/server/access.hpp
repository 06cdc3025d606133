#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace interlace::monitor {

inline constexpr std::size_t kMaxTarget = 512;          ///< of a request [bytes]
inline constexpr std::string_view kLivePath = "/live";  ///< where the frames are

/// What of a request decides whether it is answered.
struct RequestHead {
  std::string method, target, host, origin;  ///< empty: there was none
  bool upgrade = false;                      ///< to a WebSocket
};

/// The status a request is refused with and one line why; status 0: go on.
struct Refusal {
  unsigned status = 0;
  std::string text;
};

/// Other sites' pages must not read a cell through the browser of somebody who may: a page is only let in from this host itself (its
/// `Origin`), and while only this machine is served (`loopback`) only under a name of this machine (`Host`), which no name of a foreign
/// site can become. Pure.
[[nodiscard]] Refusal judge(const RequestHead& head, bool loopback);

/// Headers of every answer: nothing but the page's own files runs, nothing is guessed, nobody frames it.
[[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& security_headers();

}  // namespace interlace::monitor
