#pragma once

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace interlace::test {

/// A child process in a process group of its own. The group is killed when this object goes, and by the kernel when the test itself dies,
/// so that no test leaves one behind. Not thread-safe; the kernel's promise holds as long as the thread that made it lives.
class Process {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts `arguments[0]`; what it prints goes where the test's own output goes unless `capture` is set. Throws std::runtime_error.
  explicit Process(std::vector<std::string> arguments, bool capture = false) : arguments_(std::move(arguments)) {
    // Memory files, not pipes: a child never blocks because nobody reads, and what it printed can be read again.
    if (capture && ((output_ = ::memfd_create("stdout", MFD_CLOEXEC)) < 0 || (errors_ = ::memfd_create("stderr", MFD_CLOEXEC)) < 0)) {
      throw std::runtime_error{"no memory file for the output of " + arguments_[0]};
    }
    std::vector<char*> argv;
    for (std::string& argument : arguments_) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) become(argv, parent);
    if (pid_ < 0 || (pidfd_ = open_pidfd(pid_)) < 0) throw std::runtime_error{"cannot start " + arguments_[0]};
    ::setpgid(pid_, pid_);  // here too, so that the group exists before the child has run
  }
  ~Process() {
    kill(SIGKILL);
    for (const int fd : {output_, errors_, pidfd_}) {
      if (fd >= 0) ::close(fd);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Sends `signal` to the process alone; SIGKILL goes to its group and waits for the end. Nothing happens once it has ended.
  void kill(int signal) {
    if (exit_code_) return;
    ::kill(signal == SIGKILL ? -pid_ : pid_, signal);
    if (signal == SIGKILL) reap();
  }

  /// Exit code, 128 + signal when it was killed; empty when it still runs after `patience`. May be asked again.
  std::optional<int> wait(std::chrono::milliseconds patience) {
    pollfd ended{pidfd_, POLLIN, 0};
    if (!exit_code_ && ::poll(&ended, 1, static_cast<int>(patience.count())) == 1) reap();
    return exit_code_;
  }

  [[nodiscard]] bool running() { return !wait(std::chrono::milliseconds{0}); }

  /// Everything it has printed to stdout so far, when captured.
  [[nodiscard]] std::string output() const { return read_all(output_); }
  /// The same of stderr, where programs log.
  [[nodiscard]] std::string errors() const { return read_all(errors_); }

  /// Waits until stderr holds `text` at least `times` times; false after `patience` or when the process ends without it.
  [[nodiscard]] bool logs(const std::string& text, std::chrono::milliseconds patience, std::size_t times = 1) {
    const auto deadline = Clock::now() + patience;
    for (;;) {
      const bool ended = wait(std::chrono::milliseconds{10}).has_value();  // a memory file tells nobody that it grew
      if (count(errors(), text) >= times) return true;
      if (ended || Clock::now() >= deadline) return false;
    }
  }

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] const std::string& program() const { return arguments_[0]; }
  [[nodiscard]] const std::vector<std::string>& arguments() const { return arguments_; }

  /// How often `needle` occurs in `text`.
  [[nodiscard]] static std::size_t count(const std::string& text, const std::string& needle) {
    std::size_t n = 0;
    for (auto at = text.find(needle); at != std::string::npos; at = text.find(needle, at + needle.size())) ++n;
    return n;
  }

 private:
  /// By its number: the header of glibc 2.36 declares pidfd_open without C linkage. -1 when there is no such process.
  [[nodiscard]] static int open_pidfd(pid_t pid) { return static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)); }

  /// In the child: only what is safe after fork in a program with threads.
  [[noreturn]] void become(const std::vector<char*>& argv, pid_t parent) const {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);  // the test died before the line above
    if (output_ >= 0) {
      ::dup2(output_, STDOUT_FILENO);
      ::dup2(errors_, STDERR_FILENO);
    }
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  void reap() {
    int status = 0;
    if (::waitpid(pid_, &status, 0) != pid_) return;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ::kill(-pid_, SIGKILL);  // what it may have started itself
  }

  [[nodiscard]] static std::string read_all(int fd) {
    std::string text;
    if (fd < 0) return text;
    char buffer[4096];
    off_t at = 0;
    for (ssize_t n = 0; (n = ::pread(fd, buffer, sizeof buffer, at)) > 0; at += n) text.append(buffer, static_cast<std::size_t>(n));
    return text;
  }

  std::vector<std::string> arguments_;
  pid_t pid_ = -1;
  int pidfd_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::optional<int> exit_code_;
};

}  // namespace interlace::test
