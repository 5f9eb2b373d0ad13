#pragma once

#include <httplib.h>
#include <mutex>
#include <set>
#include <string>

namespace retrace {

/// The library's server with connections of ours, all of which can be closed at any time. A request may have
/// 64 kB and take five seconds; a client who takes nothing for ten seconds is dropped; those beyond 250 at a
/// time get the answer 503. To be compiled with the same settings of the library everywhere (CMakeLists.txt).
class ClosableServer : public httplib::Server {
 public:
  ClosableServer();

  /// Listens at an address; port 0: any that is free. Returns the port, or -1 if it cannot.
  int bind(const std::string& address, int port);

  /// Ends whatever is read or written, now and from now on.
  void hang_up();

 private:
  bool process_and_close_socket(socket_t socket) override;

  std::mutex mutex_;
  std::set<socket_t> open_;
  bool over_ = false;
};

}  // namespace retrace
