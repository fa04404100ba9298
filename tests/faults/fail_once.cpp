// Makes one call fail, in a program that is started with this before it (LD_PRELOAD):
//   VIBROSOW_FAIL=allocation:17   the 17th allocation finds no memory (of: allocation, write, fsync, rename, open,
//   mkdir) VIBROSOW_FAIL=count           fails nothing; the numbers of calls go to the file VIBROSOW_CALLS at the end
// Counted while main runs, those of all threads together. Allocations are those by `new`: what C libraries allocate is
// theirs to lose (the scanner of UDUNITS-2 ends the program). A failing write finds a full disk after half of its
// bytes.

#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <new>

namespace {

enum Call { allocation, write_call, fsync_call, rename_call, open_call, mkdir_call, calls };
constexpr const char* names[calls] = {"allocation", "write", "fsync", "rename", "open", "mkdir"};

std::atomic<long> made[calls];
long fails_at[calls];
bool started = false;

/// Whether this call is the one.
bool fails(Call call) {
  return started && ++made[call] == fails_at[call];
}

using Main = int (*)(int, char**, char**);
Main program = nullptr;

void start() {
  const char* wanted = getenv("VIBROSOW_FAIL");
  if (!wanted) return;
  for (int call = 0; call < calls; ++call) {
    const size_t length = strlen(names[call]);
    if (strncmp(wanted, names[call], length) == 0 && wanted[length] == ':')
      fails_at[call] = strtol(wanted + length + 1, nullptr, 10);
  }
  started = true;
}

void finish() {
  started = false;
  const char* file = getenv("VIBROSOW_CALLS");
  if (!file) return;
  char text[256];
  int length = 0;
  for (int call = 0; call < calls; ++call)
    length +=
        snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s %ld\n", names[call], made[call].load());
  const long descriptor = syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (descriptor < 0) return;
  syscall(SYS_write, descriptor, text, length);
  syscall(SYS_close, descriptor);
}

int watched_main(int count, char** arguments, char** environment) {
  start();
  const int code = program(count, arguments, environment);
  finish();
  return code;
}

/// As the standard library's: where there is no memory the program's handler is asked first.
void* allocated(size_t size, size_t alignment) {
  if (fails(allocation)) {
    if (const std::new_handler handler = std::get_new_handler()) handler();
    throw std::bad_alloc();
  }
  const size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = alignment > alignof(std::max_align_t) ? aligned_alloc(alignment, whole) : malloc(size ? size : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

int failed(int error) {
  errno = error;
  return -1;
}

}  // namespace

void* operator new(size_t size) {
  return allocated(size, 1);
}
void* operator new[](size_t size) {
  return allocated(size, 1);
}
void* operator new(size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<size_t>(alignment));
}

extern "C" {

// NOLINTNEXTLINE(bugprone-reserved-identifier): stands before libc's own.
int __libc_start_main(Main main, int count, char** arguments, void (*init)(), void (*fini)(), void (*linker)(),
                      void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  program = main;
  const auto real = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return real(watched_main, count, arguments, init, fini, linker, stack);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (!fails(write_call)) return syscall(SYS_write, descriptor, bytes, size);
  syscall(SYS_write, descriptor, bytes, size / 2);
  return failed(ENOSPC);
}

int fsync(int descriptor) {
  return fails(fsync_call) ? failed(EIO) : static_cast<int>(syscall(SYS_fsync, descriptor));
}

int rename(const char* from, const char* to) {
  return fails(rename_call) ? failed(EACCES) : static_cast<int>(syscall(SYS_rename, from, to));
}

int renameat2(int from_at, const char* from, int to_at, const char* to, unsigned flags) {
  return fails(rename_call) ? failed(EINVAL)
                            : static_cast<int>(syscall(SYS_renameat2, from_at, from, to_at, to, flags));
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  return fails(open_call) ? failed(EMFILE) : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int mkdir(const char* path, mode_t mode) {
  return fails(mkdir_call) ? failed(EACCES) : static_cast<int>(syscall(SYS_mkdir, path, mode));
}

}  // extern "C"
