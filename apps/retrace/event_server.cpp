#include "event_server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <deque>
#include <httplib.h>
#include <mutex>
#include <poll.h>
#include <set>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kMostClients = 250, kMostThreads = kMostClients + 6;  // six send the others away
constexpr std::chrono::seconds kRequestTime(5), kWriteTime(10), kIdleTime(15);
constexpr std::chrono::milliseconds kFarewell(500);
// No more than this is under way to a client who does not read, all of it old by the time he does.
constexpr int kSendBuffer = 1 << 15;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A thread for each client, begun when the first that needs it comes.
class Workers : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    if (tasks_.size() > idle_ && threads_.size() < kMostThreads) {
      try {
        threads_.emplace_back([this] { work(); });
      } catch (const std::system_error&) {  // no more threads: those that there are come to it
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

/// A socket, with one limit on the time that a request takes, however slowly its bytes come.
class Connection : public httplib::Stream {
 public:
  explicit Connection(socket_t socket) : socket_(socket), read_until_(SteadyClock::now() + kRequestTime) {}

  [[nodiscard]] bool is_readable() const override { return ready(POLLIN, read_until_); }
  [[nodiscard]] bool is_writable() const override { return ready(POLLOUT, SteadyClock::now()); }
  ssize_t read(char* to, std::size_t size) override {
    if (at_ == held_) {
      if (!is_readable()) return -1;
      const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
      if (count <= 0) return count;
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
};

/// The library's server with connections of ours, all of which can be closed at any time.
class ClosableServer : public httplib::Server {
 public:
  /// Ends whatever is read or written, now and from now on.
  void hang_up() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    for (const socket_t socket : open_) ::shutdown(socket, SHUT_RDWR);
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
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

  mutable std::mutex mutex_;
  std::set<socket_t> open_;
  bool over_ = false;
};

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

/// Whether a Host header names this machine by no name that another could give it.
bool names_loopback(std::string host) {
  const std::size_t colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.resize(colon);
  return host == "[::1]" || is_loopback(host);
}

}  // namespace

class EventServer::Implementation {
 public:
  Implementation(const std::string& address, int port, Files files)
      : address_(address), files_(std::move(files)) {
    server_.new_task_queue = [] { return new Workers; };
    // The library's choice lets two programs share a port.
    server_.set_socket_options([](socket_t socket) {
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    server_.set_default_headers({{"Content-Security-Policy", kPolicy},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cache-Control", "no-store"}});
    // Before the library's routes, which it has as regular expressions.
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = port == 0 ? server_.bind_to_any_port(address) : server_.bind_to_port(address, port) ? port : -1;
    if (port_ <= 0) {
      throw vo::Error(
          fmt::format("--view {}", port), fmt::format("cannot listen on {}", address),
          port == 0 ? "an address of this machine" : "an address of this machine and a free port");
    }
    listen();
  }

  ~Implementation() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    came_.notify_all();
    const auto until = SteadyClock::now() + kFarewell;
    while (anyone() && SteadyClock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    server_.stop();
    server_.hang_up();
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  [[nodiscard]] std::string url() const {
    const bool six = address_.find(':') != std::string::npos;
    return fmt::format("http://{}{}{}:{}/", six ? "[" : "", address_, six ? "]" : "", port_);
  }

  [[nodiscard]] bool anyone() const {
    const std::lock_guard lock(mutex_);
    return listeners_ > 0;
  }

  void publish(std::string data) {
    {
      const std::lock_guard lock(mutex_);
      newest_ = std::move(data);
      ++number_;
    }
    came_.notify_all();
  }

 private:
  void listen() {
    // Signals are the main thread's: one that ends the run must not find it waiting here.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    for (;;) {  // until `stop` would be heard
      if (server_.is_running()) return;
      {
        const std::lock_guard lock(mutex_);
        if (stopped_) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  static void say(httplib::Response& response, int status, const char* text) {
    response.status = status;
    response.set_content(text, "text/plain");
  }

  void answer(const httplib::Request& request, httplib::Response& response) {
    if (is_loopback(address_) && !names_loopback(request.get_header_value("Host"))) {
      say(response, 403, "this page is for this machine only\n");
      return;
    }
    if (request.method != "GET") {
      say(response, 405, "only GET is answered\n");
      response.set_header("Allow", "GET");
      return;
    }
    if (request.path == "/events") {
      auto seen = std::make_shared<std::uint64_t>(0);
      const std::lock_guard lock(mutex_);
      ++listeners_;
      response.set_chunked_content_provider(
          "text/event-stream",
          [this, seen](std::size_t, httplib::DataSink& sink) { return send_next(*seen, sink); },
          [this](bool) {
            const std::lock_guard inner(mutex_);
            --listeners_;
          });
      return;
    }
    if (const std::optional<ServedFile> file = files_(request.path)) {
      response.set_content(file->content, file->type);
      return;
    }
    say(response, 404, "there is no such page\n");
  }

  /// Waits for an event that this client has not had, and sends it.
  bool send_next(std::uint64_t& seen, httplib::DataSink& sink) {
    std::string text;
    bool last = false;
    {
      std::unique_lock lock(mutex_);
      const bool came = came_.wait_for(lock, kIdleTime, [&] { return over_ || number_ != seen; });
      last = over_ && number_ == seen;
      if (last) {
        text = "event: end\ndata:\n\n";
      } else if (came) {
        seen = number_;
        text = "data: " + newest_ + "\n\n";
      } else {
        text = ":\n\n";  // shows whether the client is still there
      }
    }
    if (!sink.write(text.data(), text.size())) return false;
    if (last) sink.done();
    return true;
  }

  std::string address_;
  Files files_;
  ClosableServer server_;
  int port_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::string newest_;
  std::uint64_t number_ = 0;  // of events so far
  std::size_t listeners_ = 0;
  bool over_ = false, stopped_ = false;
  std::thread thread_;
};

EventServer::EventServer(const std::string& address, int port, Files files) {
  // The library's server has the process ignore a closed pipe, which is not for it to say.
  struct sigaction before {};
  sigaction(SIGPIPE, nullptr, &before);
  implementation_ = std::make_unique<Implementation>(address, port, std::move(files));
  sigaction(SIGPIPE, &before, nullptr);
}
EventServer::~EventServer() = default;

std::string EventServer::url() const {
  return implementation_->url();
}
bool EventServer::anyone() const {
  return implementation_->anyone();
}
void EventServer::publish(std::string data) {
  implementation_->publish(std::move(data));
}

}  // namespace retrace
