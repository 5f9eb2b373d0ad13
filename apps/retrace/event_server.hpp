#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace retrace {

/// What the server gives out for a path.
struct ServedFile {
  std::string type;  ///< MIME type
  std::string content;
};

/// Serves files, and at /events a stream of events (server-sent events, WHATWG HTML 9.2), to browsers. Only
/// GET is answered, a request for each connection. Nothing waits for a client: one who reads too slowly gets
/// the newest event next and not those in between, one who takes nothing for ten seconds is dropped, and
/// those beyond 250 at a time are sent away. On a loopback address only requests that name it so are
/// answered, so that no page of another site reaches it under a name of its own.
class EventServer {
 public:
  /// The file of a path, or none; called by several threads at a time.
  using Files = std::function<std::optional<ServedFile>(const std::string& path)>;

  /// Listens at once. `port` 0: any that is free. Throws `vo::Error` if that cannot be.
  EventServer(const std::string& address, int port, Files files);
  /// Tells every client that this is the end, and closes all connections after half a second at most.
  ~EventServer();
  EventServer(const EventServer&) = delete;
  EventServer& operator=(const EventServer&) = delete;

  /// Of the root, for a browser on this machine.
  [[nodiscard]] std::string url() const;

  /// True if any client listens to events.
  [[nodiscard]] bool anyone() const;

  /// The event that is the newest from now on. `data`: without line ends.
  void publish(std::string data);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace retrace
