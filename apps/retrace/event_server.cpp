#include "event_server.hpp"

#include "closable_server.hpp"

#include <arpa/inet.h>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kIdleTime(15);
constexpr std::chrono::milliseconds kFarewell(500);

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

/// Whether a Host header is `localhost` or a loopback address. Any other name can be made to lead to this
/// machine by its owner (DNS rebinding).
bool names_loopback(std::string host) {
  const std::size_t colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.resize(colon);
  in_addr four{};
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24U == IN_LOOPBACKNET;
  return host == "localhost" || host == "[::1]";
}

}  // namespace

class EventServer::Implementation {
 public:
  Implementation(const std::string& address, int port, Files files)
      : address_(address), files_(std::move(files)) {
    server_.set_default_headers({{"Content-Security-Policy", kPolicy},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cache-Control", "no-store"}});
    // Before the library's routes, which it has as regular expressions.
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = server_.bind(address, port);
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
    for (;;) {  // `stop` has no effect before the server runs
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
  // httplib makes the whole process ignore SIGPIPE: put the handler back.
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
