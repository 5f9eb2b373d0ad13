#pragma once

#include "arguments.hpp"
#include "event_server.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>
#include <place/route/route.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {

/// Where a live page is served.
struct FollowViewOptions {
  std::optional<std::size_t> port;  ///< none: there is no page; 0: any that is free
  std::string address = "127.0.0.1";
};

void declare_view(Arguments& arguments, FollowViewOptions& options);

/// The page of `retrace follow --view`: what `FollowRecord` leaves, while the walk goes on. A picture is made
/// for it ten times a second at most, and only while somebody looks.
class FollowView {
 public:
  /// Serves the page at once, at a port that the options have. The route, read with previews, must outlive
  /// this. Throws `vo::Error` where the address or the port cannot be had.
  FollowView(const place::Route& route, const std::string& walk, const FollowViewOptions& options);

  [[nodiscard]] std::string url() const { return server_.url(); }

  /// The next position, the frame that it is of, and what was announced there.
  void push(const place::Position& position, const vo::Frame& frame,
            const std::vector<place::FollowEvent>& events);

 private:
  [[nodiscard]] std::optional<ServedFile> file(const std::string& path) const;

  const place::Route& route_;
  std::string page_;
  std::optional<std::chrono::steady_clock::time_point> sent_;
  std::optional<place::FollowEvent> said_;  // the last that was announced
  EventServer server_;
};

}  // namespace retrace
