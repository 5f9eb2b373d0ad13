#include "closable_server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <vector>

namespace retrace {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kMostClients = 250, kMostThreads = kMostClients + 6;  // six send the others away
constexpr std::chrono::seconds kRequestTime(5), kWriteTime(10);
constexpr std::size_t kMostRequest = 1 << 16;  // bytes; a browser's is about 1 kB
// Bytes that wait in the kernel for a client. Few, because they are out of date when a slow client reads
// them.
constexpr int kSendBuffer = 1 << 15;

/// One thread for each client, up to kMostThreads; a thread is started when none is idle, and used again.
class Workers : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    if (tasks_.size() > idle_ && threads_.size() < kMostThreads) {
      try {
        threads_.emplace_back([this] { work(); });
      } catch (const std::system_error&) {  // no more threads: those already running take the task
      }
    }
    came_.notify_one();
  }
  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    came_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      ++idle_;
      came_.wait(lock, [this] { return over_ || !tasks_.empty(); });
      --idle_;
      if (tasks_.empty()) return;
      const std::function<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;
  bool over_ = false;
};

/// A socket, with limits on the size of a request and on the time that it takes, however slowly its bytes
/// come.
class Connection : public httplib::Stream {
 public:
  explicit Connection(socket_t socket) : socket_(socket), read_until_(SteadyClock::now() + kRequestTime) {}

  [[nodiscard]] bool is_readable() const override { return ready(POLLIN, read_until_); }
  [[nodiscard]] bool is_writable() const override { return ready(POLLOUT, SteadyClock::now()); }
  ssize_t read(char* to, std::size_t size) override {
    if (at_ == held_) {
      if (left_ == 0 || !is_readable()) return -1;
      const ssize_t count = ::recv(socket_, buffer_.data(), std::min(buffer_.size(), left_), 0);
      if (count <= 0) return count;
      left_ -= static_cast<std::size_t>(count);
      at_ = 0;
      held_ = static_cast<std::size_t>(count);
    }
    const std::size_t count = std::min(size, held_ - at_);
    std::copy_n(buffer_.data() + at_, count, to);
    at_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    if (!ready(POLLOUT, SteadyClock::now() + kWriteTime)) return -1;
    const ssize_t count = ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    return count < 0 && errno == EAGAIN ? 0 : count;
  }
  void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  [[nodiscard]] bool ready(short events, SteadyClock::time_point until) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - SteadyClock::now());
    pollfd waiting{.fd = socket_, .events = events, .revents = 0};
    return ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(0, left.count()))) > 0;
  }

  socket_t socket_;
  SteadyClock::time_point read_until_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, held_ = 0;
  std::size_t left_ = kMostRequest;
};

}  // namespace

ClosableServer::ClosableServer() {
  new_task_queue = [] { return new Workers; };
  // The library's choice lets two programs share a port.
  set_socket_options([](socket_t socket) {
    const int on = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
}

int ClosableServer::bind(const std::string& address, int port) {
  const int bound = port == 0 ? bind_to_any_port(address) : bind_to_port(address, port) ? port : -1;
  // The library has five wait at most: of many that come at once, the others would try again a second later.
  if (bound > 0) ::listen(svr_sock_, static_cast<int>(kMostThreads));
  return bound;
}

void ClosableServer::hang_up() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  for (const socket_t socket : open_) ::shutdown(socket, SHUT_RDWR);
}

bool ClosableServer::process_and_close_socket(socket_t socket) {
  bool room = false;
  {
    const std::lock_guard lock(mutex_);
    room = !over_ && open_.size() < kMostClients;
    open_.insert(socket);
  }
  ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  Connection connection(socket);
  bool done = false;
  if (room) {
    bool closed = false;
    done = process_request(connection, true, closed, [](httplib::Request& request) {
      request.headers.erase("Accept-Encoding");  // a compressed event would wait for others
      request.ranges.clear();
    });
  } else {
    constexpr std::string_view kBusy =
        "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
    connection.write(kBusy.data(), kBusy.size());
  }
  const std::lock_guard lock(mutex_);
  open_.erase(socket);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return done;
}

}  // namespace retrace
