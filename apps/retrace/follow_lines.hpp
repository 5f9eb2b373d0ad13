#pragma once

#include <string>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>

namespace retrace {

/// A position as a line of JSON, without the end of the line; what is not known is not there.
std::string follow_line(const place::Position& position);

/// An event as such a line.
std::string event_line(const place::FollowEvent& event);

}  // namespace retrace
