#pragma once

#include <atomic>

namespace vibrosow {

/// Thrown where work that has no result yet is broken off on request.
struct Interrupted {};

/// A flag that is set elsewhere, by a signal or another thread, to end what takes long. None: nobody asks.
class StopRequest {
 public:
  StopRequest(const std::atomic<bool>* flag = nullptr) : flag_(flag) {}
  bool is_set() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Throws Interrupted.
  void throw_if_set() const {
    if (is_set()) throw Interrupted();
  }

 private:
  const std::atomic<bool>* flag_;
};

}  // namespace vibrosow
