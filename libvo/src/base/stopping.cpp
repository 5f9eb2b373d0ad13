#include "vo/base/stopping.hpp"

#include <utility>

namespace vo {
namespace {

thread_local Stopping* the_stopping = nullptr;

}  // namespace

Stopping::Stopping(std::function<bool()> asked)
    : asked_(std::move(asked)), outer_(std::exchange(the_stopping, this)) {}

Stopping::~Stopping() {
  the_stopping = outer_;
}

Stopping* Stopping::current() {
  return the_stopping;
}

Stopping* Stopping::exchange_current(Stopping* stopping) {
  return std::exchange(the_stopping, stopping);
}

bool Stopping::poll() {
  if (stopped_.load(std::memory_order_relaxed)) return true;
  if (!is_of_this_thread()) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < due_) return false;
  due_ = now + kInterval;
  if (asked_()) stopped_ = true;
  return stopped_;
}

}  // namespace vo
