#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>

namespace retrace {

/// A position as a line of JSON, without the end of the line; what is not known is not there.
std::string follow_line(const place::Position& position);

/// An event as such a line.
std::string event_line(const place::FollowEvent& event);

/// The lines of a walk: each goes to standard output as soon as it is known, and into `follow.jsonl` in a
/// folder, such as one of `StagedFiles`.
class FollowLines {
 public:
  /// `folder`: empty for none.
  explicit FollowLines(const std::filesystem::path& folder);

  void write(const std::string& line);
  /// Throws `vo::Error` naming the file if not all of it could be written.
  void finish();

 private:
  std::filesystem::path folder_;
  std::ofstream file_;
};

}  // namespace retrace
