#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace interlace::test {

/// A TCP connection to a server on this machine that sends whatever bytes a test wants. Every wait has an end. Not thread-safe.
class WebClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// `receive_buffer` [bytes], when given, keeps the kernel from taking much for somebody who does not read. Throws std::runtime_error.
  explicit WebClient(std::uint16_t port, int receive_buffer = 0) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (fd_ >= 0 && receive_buffer > 0) ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (fd_ < 0 || ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      if (fd_ >= 0) ::close(fd_);
      throw std::runtime_error{"cannot connect"};
    }
  }
  ~WebClient() {
    if (fd_ >= 0) ::close(fd_);
  }
  WebClient(WebClient&& other) noexcept : fd_(std::exchange(other.fd_, -1)), bytes_(std::move(other.bytes_)), closed_(other.closed_) {}
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  /// False when the server does not take it any more.
  bool send(const std::string& bytes) {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }

  /// Everything that comes until the server closes; empty when it has not closed after `patience`.
  [[nodiscard]] std::optional<std::string> until_closed(std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    while (!closed_) {
      if (!receive(deadline)) return std::nullopt;
    }
    return std::exchange(bytes_, {});
  }

  /// An answer to HTTP: everything up to the end of its head, and what came with it; empty after `patience`, or when none came.
  [[nodiscard]] std::optional<std::string> head(std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    while (bytes_.find("\r\n\r\n") == std::string::npos) {
      if (closed_ || !receive(deadline)) return std::nullopt;
    }
    const auto end = bytes_.find("\r\n\r\n") + 4;
    std::string text = bytes_.substr(0, end);
    bytes_.erase(0, end);
    return text;
  }

  /// Becomes a viewer of the frames; false when the server does not want that.
  [[nodiscard]] bool look_on(std::uint16_t port, std::chrono::milliseconds patience) {
    send("GET /live HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
         "dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    const auto answer = head(patience);
    return answer && answer->rfind("HTTP/1.1 101", 0) == 0;
  }

  /// The next text the server sends; empty after `patience` or when it has closed.
  [[nodiscard]] std::optional<std::string> next_frame(std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    for (;;) {
      if (auto frame = take_frame()) {
        if (frame->first == 0x8) return std::nullopt;  // it closes
        if (frame->first == 0x1) return std::move(frame->second);
        continue;
      }
      if (closed_ || !receive(deadline)) return std::nullopt;
    }
  }

  /// Whether the server ends this, by a closing frame or at once; false after `patience`.
  [[nodiscard]] bool ends(std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    for (;;) {
      while (const auto frame = take_frame()) {
        if (frame->first == 0x8) return true;
      }
      if (closed_) return true;
      if (!receive(deadline)) return false;
    }
  }

  /// A frame as a browser sends it: masked.
  [[nodiscard]] static std::string masked(unsigned char first, const std::string& text) {
    std::string frame(1, static_cast<char>(first));
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8);
      frame += static_cast<char>(text.size() & 0xff);
    }
    const std::string mask = "\x12\x34\x56\x78";
    frame += mask;
    for (std::size_t i = 0; i < text.size(); ++i) frame += static_cast<char>(text[i] ^ mask[i % 4]);
    return frame;
  }

  [[nodiscard]] bool closed() const { return closed_; }

 private:
  /// Waits for more; false: none came in time.
  bool receive(Clock::time_point deadline) {
    pollfd readable{fd_, POLLIN, 0};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || ::poll(&readable, 1, static_cast<int>(left)) <= 0) return false;
    char buffer[16384];
    const ssize_t n = ::recv(fd_, buffer, sizeof buffer, 0);
    if (n <= 0) {
      closed_ = true;
    } else {
      bytes_.append(buffer, static_cast<std::size_t>(n));
    }
    return true;
  }

  /// Opcode and content of a whole frame, when there is one.
  std::optional<std::pair<int, std::string>> take_frame() {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes_[i]); };
    if (bytes_.size() < 2) return std::nullopt;
    std::uint64_t length = byte(1) & 0x7fU;
    std::size_t begin = 2;
    if (length >= 126) {
      const std::size_t extra = length == 126 ? 2 : 8;
      if (bytes_.size() < begin + extra) return std::nullopt;
      length = 0;
      for (std::size_t i = 0; i < extra; ++i) length = length << 8U | byte(begin + i);
      begin += extra;
    }
    if (bytes_.size() < begin + length) return std::nullopt;
    auto frame = std::make_pair(static_cast<int>(byte(0) & 0xfU), bytes_.substr(begin, length));
    bytes_.erase(0, begin + length);
    return frame;
  }

  int fd_;
  std::string bytes_;  // received and not yet taken
  bool closed_ = false;
};

}  // namespace interlace::test
