#pragma once

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vibrosow {

/// From now on a closed pipe or a closed standard stream stops nothing: no signal, and no other file gets the number of
/// a closed stream. A file over the size limit is a failed write, told as one.
void make_streams_safe();

/// From now on the program ends with one line and the exit code of wrong input when memory runs out. At once, since
/// libraries take a failed allocation for something else: a stream then holds half of what was written to it, a TOML
/// reader calls a number no number. Reports on the disk stay what they were.
void end_when_memory_runs_out();

/// Prints on standard output, as `printable_lines`: what was read from a file moves no cursor. Never throws: a reader
/// that has gone away is no error, what else cannot be printed is kept for `output_error`.
void print_text(const std::string& text);
template <class... Arguments>
void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  print_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Prints "vibrosow: TEXT" on standard error, one line whatever the text. Never throws.
void complain(const std::string& text);

/// What `program` returns; where it throws, complains and returns the code of what it threw: wrong input for an
/// `InputError` and for what the system refuses, such as a file that cannot be written; a defect for all else.
int exit_code_of(const std::function<int()>& program);

/// A command of the program as it is typed in a shell, quoted where it has to be.
std::string typed_line(const std::vector<std::string>& words);

/// Brings what was printed out of the program; why it could not be, if so ("No space left on device").
std::optional<std::string> output_error();

/// Writes the reports, then prints the table: also where the reports cannot be written, and then even when `quiet`,
/// since it is all that is left of the work. Throws what `write` threw.
template <class Write, class Table>
void write_then_print(bool quiet, Write write, Table table) {
  std::exception_ptr failure;
  try {
    write();
  } catch (...) {
    failure = std::current_exception();
  }
  if (!quiet || failure) table();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vibrosow
