#include "cli/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/commands.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

int first_error = 0;  // of standard output

void note_error() {
  if (first_error == 0 && errno != EPIPE) first_error = errno;
}

}  // namespace

void make_streams_safe() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDWR);  // takes the lowest free number
}

void end_when_memory_runs_out() {
  std::set_new_handler([] {
    constexpr std::string_view line = "vibrosow: out of memory\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
    std::_Exit(exit_wrong_input);
  });
}

void print_text(const std::string& raw) {
  const std::string text = printable_lines(raw);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_error();
}

void complain(const std::string& text) {
  const std::string line = "vibrosow: " + printable(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);  // nobody is left to be told of a failure
}

std::string typed_line(const std::vector<std::string>& words) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+%";  // to every shell
  std::string line = "vibrosow";
  for (const std::string& word : words) {
    const bool is_plain = !word.empty() && word.find_first_not_of(plain) == std::string::npos;
    line += " " + (is_plain ? word : shell_quoted(word));
  }
  return line;
}

int exit_code_of(const std::function<int()>& program) {
  try {
    return program();
  } catch (const InputError& error) {
    complain(error.what());
  } catch (const std::system_error& error) {
    complain(error.what());
  } catch (const std::exception& error) {
    complain(fmt::format("a defect of the program, please report it with your file: {}", error.what()));
    return exit_defect;
  } catch (...) {
    complain("a defect of the program, please report it with your file");
    return exit_defect;
  }
  return exit_wrong_input;
}

std::optional<std::string> output_error() {
  if (std::fflush(stdout) != 0) note_error();
  return first_error != 0 ? std::optional<std::string>(std::strerror(first_error)) : std::nullopt;
}

}  // namespace vibrosow
