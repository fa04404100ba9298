#pragma once

#include <functional>
#include <memory>

namespace vibrosow {

/// Threads that share the loops of one run. A build without threads (VIBROSOW_THREADS=OFF) has teams of one.
class ThreadTeam {
 public:
  /// `threads` >= 1. Throws std::invalid_argument for more than one in a build without threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(ThreadTeam&&) noexcept;
  ThreadTeam& operator=(ThreadTeam&&) noexcept;

  int size() const { return size_; }
  /// Calls work(k) for each k in 0 .. size - 1 and returns when all are done.
  void share(const std::function<void(int)>& work);

 private:
  struct Pool;
  int size_;
  std::unique_ptr<Pool> pool_;  // none for a single thread
};

}  // namespace vibrosow
