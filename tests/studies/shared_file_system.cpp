// A poor file system, for a program that is started with this before it (LD_PRELOAD). Of what lies under the folder
// VIBROSOW_SHARED, it is told by these whatever else is wrong; each is off where its variable is not set:
//   VIBROSOW_SHARED_FULL=FILE     while that file exists the disk is full: writes fail, or half-way, or seem to succeed
//                                 and what was written is lost, which fsync and close then say; new files and
//                                 directories, too
//   VIBROSOW_SHARED_STALE=2.5     what another host, or process, renamed to a path is seen there up to so many seconds
//   late, until
//                                 then what was there before; listings lack what is new, and name what others removed
//   VIBROSOW_SHARED_LIES=0.1      so often a rename, link, unlink or mkdir says that it failed and has succeeded, as
//   where
//                                 a request was sent twice
//   VIBROSOW_SHARED_CLOCK=3600    the clock is so many seconds ahead; files' times are the server's
//   VIBROSOW_SHARED_HOST=NAME     the name of this host
//   VIBROSOW_SHARED_PID=17        the number of this process: another host may have the same
// VIBROSOW_SHARED_SEED=N is the start of all chance. VIBROSOW_SHARED_NOTES is a directory on the same file system for
// this library's own use, common to all processes; there lies `log`: a line a fault, and a line a run that is kept.
// A program dies with the one that started it.

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

std::string text_setting(const char* name) {
  const char* value = getenv((std::string("VIBROSOW_SHARED") + name).c_str());
  return value ? value : "";
}

double number_setting(const char* name) {
  return strtod(text_setting(name).c_str(), nullptr);
}

struct Settings {
  std::string folder = text_setting(""), full = text_setting("_FULL"), notes = text_setting("_NOTES"),
              host = text_setting("_HOST");
  double stale = number_setting("_STALE"), lies = number_setting("_LIES");
  long clock = static_cast<long>(number_setting("_CLOCK")), pid = static_cast<long>(number_setting("_PID"));
  std::uint64_t seed = static_cast<std::uint64_t>(number_setting("_SEED"));
};

const Settings& settings() {
  static const Settings settings;
  return settings;
}

std::string own_number() {
  return std::to_string(syscall(SYS_getpid));
}

/// Who sees at once what it did itself: all processes of a host.
const std::string& own_name() {
  static const std::string name = settings().host.empty() ? own_number() : settings().host;
  return name;
}

// Chance

std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

/// From 0 to 1.
double share(std::uint64_t bits) {
  return static_cast<double>(mixed(bits ^ mixed(settings().seed)) >> 11) * 0x1p-53;
}

double next_share() {
  static std::atomic<std::uint64_t> drawn;
  return share(++drawn);
}

std::uint64_t hash(const std::string& text) {
  std::uint64_t bits = 0xcbf29ce484222325;
  for (const char c : text) bits = (bits ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return mixed(bits);
}

// Paths

std::string place_of(int descriptor) {
  const std::string link = descriptor == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/" + std::to_string(descriptor);
  std::array<char, 4096> target;
  const ssize_t size = readlink(link.c_str(), target.data(), target.size());
  return size < 0 ? "" : std::string(target.data(), static_cast<std::size_t>(size));
}

std::string whole_path(int at, const char* path) {
  const std::string text = path[0] == '/' ? path : place_of(at) + '/' + path;
  std::string whole = std::filesystem::path(text).lexically_normal().string();
  while (whole.size() > 1 && whole.back() == '/') whole.pop_back();
  return whole;
}

bool is_shared(const std::string& path) {
  const std::string& folder = settings().folder;
  return !folder.empty() && path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

bool is_shared(int descriptor) {
  return !settings().folder.empty() && is_shared(place_of(descriptor));
}

std::pair<std::string, std::string> directory_and_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return {path.substr(0, slash), path.substr(slash + 1)};
}

// What the processes tell each other: small files that appear whole

int failed(int error) {
  errno = error;
  return -1;
}

void write_text(const std::string& path, int flags, const std::string& text) {
  const long descriptor = syscall(SYS_openat, AT_FDCWD, path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) return;
  syscall(SYS_write, descriptor, text.data(), text.size());
  syscall(SYS_close, descriptor);
}

void log(const char* what, const std::string& path) {
  const int kept_errno = errno;
  write_text(settings().notes + "/log", O_APPEND, std::string(what) + ' ' + path + '\n');
  errno = kept_errno;
}

/// A name in the directory of notes that nobody else has.
std::string fresh_name(const char* kind) {
  static std::atomic<int> made;
  return settings().notes + '/' + kind + '.' + own_number() + '.' + std::to_string(++made);
}

void write_note(const std::string& name, const std::string& text) {
  const std::string temporary = fresh_name("new");
  write_text(temporary, O_TRUNC, own_name() + ' ' + text);
  syscall(SYS_renameat2, AT_FDCWD, temporary.c_str(), AT_FDCWD, (settings().notes + '/' + name).c_str(), 0);
}

struct Note {
  std::string by, text;
};

std::optional<Note> read_note(const std::string& name) {
  const long descriptor =
      syscall(SYS_openat, AT_FDCWD, (settings().notes + '/' + name).c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (descriptor < 0) return std::nullopt;
  std::array<char, 4096> bytes;
  const long size = syscall(SYS_read, descriptor, bytes.data(), bytes.size());
  syscall(SYS_close, descriptor);
  const std::string text(bytes.data(), static_cast<std::size_t>(std::max(size, 0L)));
  const std::size_t space = text.find(' ');
  if (space == std::string::npos) return std::nullopt;
  return Note{text.substr(0, space), text.substr(space + 1)};
}

/// Whether what happened to a path at that time is not to be seen here yet.
bool is_too_new(const std::string& path, const statx_timestamp& when) {
  timespec now;
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  const double age = static_cast<double>(now.tv_sec - when.tv_sec) +
                     (static_cast<double>(now.tv_nsec) - static_cast<double>(when.tv_nsec)) * 1e-9;
  const auto moment = static_cast<std::uint64_t>(when.tv_sec) * 1'000'000'000 + when.tv_nsec;
  return age < settings().stale * share(hash(path) ^ moment);
}

bool is_note_too_new(const std::string& path, const std::string& note) {
  struct statx times;
  return syscall(SYS_statx, AT_FDCWD, (settings().notes + '/' + note).c_str(), 0, STATX_MTIME, &times) == 0 &&
         is_too_new(path, times.stx_mtime);
}

std::string name_of_note(const char* kind, const std::string& path) {
  const auto [directory, name] = directory_and_name(path);
  return std::string(kind) + '.' + std::to_string(hash(directory)) + '.' + std::to_string(hash(name));
}

bool is_noted_by_own(const char* kind, const std::string& path) {
  const std::optional<Note> note = read_note(name_of_note(kind, path));
  return note && note->by == own_name();
}

void note_new_name(const std::string& path) {
  if (settings().stale > 0) write_note(name_of_note("new", path), "");
}

/// Before a path gets another content: a link to what it has, so that it can still be seen.
std::string former_content(const std::string& path) {
  if (settings().stale <= 0) return "";
  const std::string link = fresh_name("former");
  return syscall(SYS_linkat, AT_FDCWD, path.c_str(), AT_FDCWD, link.c_str(), 0) == 0 ? link : "";
}

void note_new_content(const std::string& path, const std::string& former) {
  if (path.ends_with(".case")) log("kept", path);
  if (settings().stale > 0) write_note(name_of_note("at", path), former);
}

/// The path whose content is seen at this one; none where nothing is seen there.
std::optional<std::string> seen(const std::string& path) {
  if (settings().stale <= 0 || !is_shared(path)) return path;
  const std::string name = name_of_note("at", path);
  const std::optional<Note> note = read_note(name);
  if (!note || note->by == own_name() || !is_note_too_new(path, name)) return path;
  log("late", path);
  if (note->text.empty()) return std::nullopt;
  return note->text;
}

// A full disk

bool disk_is_full() {
  return !settings().full.empty() && syscall(SYS_faccessat, AT_FDCWD, settings().full.c_str(), F_OK) == 0;
}

int no_space(const std::string& path) {
  log("full", path);
  return failed(ENOSPC);
}

/// Descriptors of which something was written only seemingly.
std::array<std::atomic<bool>, 4096> lost;

bool is_lost(int descriptor) {
  return descriptor >= 0 && static_cast<std::size_t>(descriptor) < lost.size() &&
         lost[static_cast<std::size_t>(descriptor)];
}

ssize_t write_to_full_disk(int descriptor, const void* bytes, std::size_t size) {
  const double chance = next_share();
  if (chance < 1.0 / 3 && static_cast<std::size_t>(descriptor) < lost.size()) {
    lost[static_cast<std::size_t>(descriptor)] = true;
    const std::string nothing(size, '\0');
    return syscall(SYS_write, descriptor, nothing.data(), size);
  }
  if (chance < 2.0 / 3) syscall(SYS_write, descriptor, bytes, size / 2);
  return no_space(place_of(descriptor));
}

// A server that lies

bool lies() {
  return settings().lies > 0 && next_share() < settings().lies;
}

int lie(int error, const std::string& path) {
  log("lie", path);
  return failed(error);
}

// What programs call

bool exists(const std::string& path) {
  return syscall(SYS_faccessat, AT_FDCWD, path.c_str(), F_OK) == 0;
}

int open_at(int at, const char* path, int flags, mode_t mode) {
  if (settings().folder.empty()) return static_cast<int>(syscall(SYS_openat, at, path, flags, mode));
  const std::string whole = whole_path(at, path);
  if (!is_shared(whole)) return static_cast<int>(syscall(SYS_openat, at, path, flags, mode));
  if (flags & O_CREAT) {
    const bool is_new = !exists(whole);
    if (is_new && disk_is_full() && next_share() < 0.3) return no_space(whole);
    const int descriptor = static_cast<int>(syscall(SYS_openat, at, path, flags, mode));
    if (descriptor >= 0 && is_new) note_new_name(whole);
    return descriptor;
  }
  const std::optional<std::string> as = seen(whole);
  return as ? static_cast<int>(syscall(SYS_openat, AT_FDCWD, as->c_str(), flags, mode)) : failed(ENOENT);
}

FILE* open_stream(const char* function, const char* path, const char* mode) {
  using Open = FILE* (*)(const char*, const char*);
  const auto real = reinterpret_cast<Open>(dlsym(RTLD_NEXT, function));
  if (settings().folder.empty()) return real(path, mode);
  const std::string whole = whole_path(AT_FDCWD, path);
  if (!is_shared(whole)) return real(path, mode);
  if (mode[0] != 'r') {
    const bool is_new = !exists(whole);
    if (is_new && disk_is_full() && next_share() < 0.3) return no_space(whole), nullptr;
    FILE* stream = real(path, mode);
    if (stream && is_new) note_new_name(whole);
    return stream;
  }
  const std::optional<std::string> as = seen(whole);
  return as ? real(as->c_str(), mode) : (failed(ENOENT), nullptr);
}

int status_at(const char* path, void* status, int flags) {
  if (settings().folder.empty()) return static_cast<int>(syscall(SYS_newfstatat, AT_FDCWD, path, status, flags));
  const std::optional<std::string> as = seen(whole_path(AT_FDCWD, path));
  return as ? static_cast<int>(syscall(SYS_newfstatat, AT_FDCWD, as->c_str(), status, flags)) : failed(ENOENT);
}

int rename_at(int from_at, const char* from, int to_at, const char* to, unsigned flags) {
  const std::string path = settings().folder.empty() ? "" : whole_path(to_at, to);
  if (!is_shared(path)) return static_cast<int>(syscall(SYS_renameat2, from_at, from, to_at, to, flags));
  if (disk_is_full() && next_share() < 0.3) return no_space(path);
  const std::string former = former_content(path);
  if (syscall(SYS_renameat2, from_at, from, to_at, to, flags) != 0) return -1;
  note_new_content(path, former);
  return lies() ? lie(next_share() < 0.5 ? EIO : ENOENT, path) : 0;
}

int link_at(int from_at, const char* from, int to_at, const char* to, int flags) {
  const std::string path = settings().folder.empty() ? "" : whole_path(to_at, to);
  if (!is_shared(path)) return static_cast<int>(syscall(SYS_linkat, from_at, from, to_at, to, flags));
  if (disk_is_full() && next_share() < 0.3) return no_space(path);
  if (syscall(SYS_linkat, from_at, from, to_at, to, flags) != 0) return -1;
  note_new_content(path, "");
  return lies() ? lie(EEXIST, path) : 0;
}

int unlink_at(int at, const char* path, int flags) {
  const std::string whole = settings().folder.empty() ? "" : whole_path(at, path);
  if (syscall(SYS_unlinkat, at, path, flags) != 0) return -1;
  if (!is_shared(whole)) return 0;
  if (whole.ends_with(".case")) log("removed", whole);
  if (settings().stale > 0) write_note(name_of_note("gone", whole), directory_and_name(whole).second);
  return lies() ? lie(ENOENT, whole) : 0;
}

/// A listing under way: what is removed and still named comes last.
struct Listing {
  bool at_end = false;
  std::vector<std::string> removed;
  dirent entry = {};
};

std::mutex mutex;  // of the listings
std::map<DIR*, Listing>& listings() {
  static std::map<DIR*, Listing> listings;
  return listings;
}

bool is_hidden(const std::string& directory, const char* name) {
  if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0) return false;
  const std::string path = directory + '/' + name;
  if (is_noted_by_own("new", path) || is_noted_by_own("at", path)) return false;
  struct statx times;
  if (syscall(SYS_statx, AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_BTIME | STATX_CTIME, &times) != 0)
    return false;
  const bool is_directory = (times.stx_mode & S_IFMT) == S_IFDIR;  // what is in it changes its times
  const bool hidden = is_too_new(path, is_directory ? times.stx_btime : times.stx_ctime);
  if (hidden) log("hidden", path);
  return hidden;
}

dirent* real_entry(DIR* stream) {
  using Read = dirent* (*)(DIR*);
  static const auto real = reinterpret_cast<Read>(dlsym(RTLD_NEXT, "readdir"));
  return real(stream);
}

/// Names of what others removed from a directory a short while ago.
std::vector<std::string> still_named(const std::string& directory) {
  std::vector<std::string> names;
  using Open = DIR* (*)(const char*);
  using Close = int (*)(DIR*);
  DIR* notes = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "opendir"))(settings().notes.c_str());
  if (!notes) return names;
  const std::string start = "gone." + std::to_string(hash(directory)) + '.';
  while (const dirent* entry = real_entry(notes)) {
    const std::string name = entry->d_name;
    const std::optional<Note> note = name.starts_with(start) ? read_note(name) : std::nullopt;
    if (!note || note->by == own_name() || exists(directory + '/' + note->text)) continue;
    if (is_note_too_new(directory + '/' + note->text, name)) names.push_back(note->text);
  }
  reinterpret_cast<Close>(dlsym(RTLD_NEXT, "closedir"))(notes);
  return names;
}

dirent* removed_entry(DIR* stream, const std::string& directory) {
  const std::lock_guard lock(mutex);
  Listing& listing = listings()[stream];
  if (!listing.at_end) listing.removed = still_named(directory);
  listing.at_end = true;
  if (listing.removed.empty()) return nullptr;
  const std::string name = listing.removed.back();
  listing.removed.pop_back();
  listing.entry = {};
  listing.entry.d_ino = 1, listing.entry.d_type = DT_REG, listing.entry.d_reclen = sizeof listing.entry;
  name.copy(listing.entry.d_name, sizeof listing.entry.d_name - 1);
  log("ghost", directory + '/' + name);
  return &listing.entry;
}

/// Leaves errno as it is, but where the listing fails: by that alone its end is told from a failure.
dirent* next_entry(DIR* stream) {
  if (settings().stale <= 0) return real_entry(stream);
  const int kept_errno = errno;
  const std::string directory = place_of(dirfd(stream));
  const bool shared = is_shared(directory);
  dirent* entry = nullptr;
  do {
    errno = kept_errno;
    entry = real_entry(stream);
    if (!shared || (!entry && errno != kept_errno)) return entry;
  } while (entry && is_hidden(directory, entry->d_name));
  if (!entry) entry = removed_entry(stream, directory);
  errno = kept_errno;
  return entry;
}

mode_t mode_of(int flags, va_list rest) {
  return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
}

__attribute__((constructor)) void start() {
  if (!settings().folder.empty()) prctl(PR_SET_PDEATHSIG, SIGKILL);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at(AT_FDCWD, path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at(AT_FDCWD, path, flags, mode);
}

int openat(int at, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at(at, path, flags, mode);
}

int openat64(int at, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at(at, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  return open_stream("fopen", path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  return open_stream("fopen64", path, mode);
}

int stat(const char* path, struct stat* status) {
  return status_at(path, status, 0);
}

int stat64(const char* path, struct stat64* status) {
  return status_at(path, status, 0);
}

int lstat(const char* path, struct stat* status) {
  return status_at(path, status, AT_SYMLINK_NOFOLLOW);
}

int lstat64(const char* path, struct stat64* status) {
  return status_at(path, status, AT_SYMLINK_NOFOLLOW);
}

int access(const char* path, int mode) {
  const std::optional<std::string> as = settings().folder.empty() ? path : seen(whole_path(AT_FDCWD, path));
  return as ? static_cast<int>(syscall(SYS_faccessat, AT_FDCWD, as->c_str(), mode)) : failed(ENOENT);
}

dirent* readdir(DIR* stream) {
  return next_entry(stream);
}

dirent64* readdir64(DIR* stream) {
  return reinterpret_cast<dirent64*>(next_entry(stream));
}

int closedir(DIR* stream) {
  using Close = int (*)(DIR*);
  static const auto real = reinterpret_cast<Close>(dlsym(RTLD_NEXT, "closedir"));
  {
    const std::lock_guard lock(mutex);
    listings().erase(stream);
  }
  return real(stream);
}

int rename(const char* from, const char* to) {
  return rename_at(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int renameat(int from_at, const char* from, int to_at, const char* to) {
  return rename_at(from_at, from, to_at, to, 0);
}

int renameat2(int from_at, const char* from, int to_at, const char* to, unsigned flags) {
  return rename_at(from_at, from, to_at, to, flags);
}

int link(const char* from, const char* to) {
  return link_at(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int linkat(int from_at, const char* from, int to_at, const char* to, int flags) {
  return link_at(from_at, from, to_at, to, flags);
}

int unlink(const char* path) {
  return unlink_at(AT_FDCWD, path, 0);
}

int unlinkat(int at, const char* path, int flags) {
  return unlink_at(at, path, flags);
}

int remove(const char* path) {
  if (unlink_at(AT_FDCWD, path, 0) == 0) return 0;
  return errno == EISDIR ? unlink_at(AT_FDCWD, path, AT_REMOVEDIR) : -1;
}

int mkdir(const char* path, mode_t mode) {
  const std::string whole = settings().folder.empty() ? "" : whole_path(AT_FDCWD, path);
  if (!is_shared(whole)) return static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
  if (disk_is_full() && !exists(whole)) return no_space(whole);
  if (syscall(SYS_mkdirat, AT_FDCWD, path, mode) != 0) return -1;
  note_new_name(whole);
  return lies() ? lie(EEXIST, whole) : 0;
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (!disk_is_full() || !is_shared(descriptor)) return syscall(SYS_write, descriptor, bytes, size);
  return write_to_full_disk(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const iovec* pieces, int count) {
  if (disk_is_full() && is_shared(descriptor)) return no_space(place_of(descriptor));
  return syscall(SYS_writev, descriptor, pieces, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  if (disk_is_full() && is_shared(descriptor)) return no_space(place_of(descriptor));
  return syscall(SYS_pwrite64, descriptor, bytes, size, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  return pwrite(descriptor, bytes, size, offset);
}

int fsync(int descriptor) {
  if (is_lost(descriptor)) return no_space(place_of(descriptor));
  if (!settings().folder.empty()) return 0;  // no power is lost here, and disks take their time
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

int fdatasync(int descriptor) {
  return fsync(descriptor);
}

int close(int descriptor) {
  const bool was_lost = is_lost(descriptor);
  if (was_lost) lost[static_cast<std::size_t>(descriptor)] = false;
  const int closed = static_cast<int>(syscall(SYS_close, descriptor));
  return was_lost && closed == 0 ? failed(ENOSPC) : closed;
}

int clock_gettime(clockid_t clock, timespec* now) {
  const int result = static_cast<int>(syscall(SYS_clock_gettime, clock, now));
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += settings().clock;
  return result;
}

time_t time(time_t* to) {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (to) *to = now.tv_sec;
  return now.tv_sec;
}

int gettimeofday(timeval* now, void*) {
  timespec precise;
  clock_gettime(CLOCK_REALTIME, &precise);
  *now = {precise.tv_sec, precise.tv_nsec / 1000};
  return 0;
}

int gethostname(char* name, size_t size) {
  utsname system;
  uname(&system);
  if (strlen(system.nodename) >= size) return failed(ENAMETOOLONG);
  memcpy(name, system.nodename, strlen(system.nodename) + 1);
  return 0;
}

int uname(utsname* system) {
  const int result = static_cast<int>(syscall(SYS_uname, system));
  if (result == 0 && !settings().host.empty())
    snprintf(system->nodename, sizeof system->nodename, "%s", settings().host.c_str());
  return result;
}

pid_t getpid() {
  return static_cast<pid_t>(settings().pid ? settings().pid : syscall(SYS_getpid));
}

}  // extern "C"
