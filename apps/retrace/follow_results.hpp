#pragma once

#include "follow_files.hpp"
#include "follow_lines.hpp"
#include "follow_matches.hpp"
#include "follow_record.hpp"
#include "run_directory.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>

namespace retrace {

/// The results of `retrace follow`: every position and event as a line on standard output, at once, and, with
/// a folder, `kFollowFiles` in it, all of them or none.
class FollowResults {
 public:
  /// `folder`: one that exists (`prepare_run_directory`), or empty for lines alone. The route must outlive
  /// this.
  FollowResults(const place::Route& route, const std::filesystem::path& folder);

  /// The next position, the frame that it is of, and what is announced there.
  void push(const place::Position& position, const vo::Frame& frame,
            const std::vector<place::FollowEvent>& announced);

  /// Writes the files. `run`: what is known of it but for its positions. `settings`, `earlier`: the
  /// follower's at the end. Throws `vo::Error` naming a file that cannot be written.
  void finish(FollowRun run, const place::Settings& settings,
              const std::vector<place::EarlierPlace>& earlier);

 private:
  const place::Route& route_;
  std::unique_ptr<StagedFiles> staged_;  // null without a folder
  FollowLines lines_;
  FollowRecord record_;
  FollowMatches matches_;
  std::int64_t frames_ = 0, on_route_ = 0;
  double duration_s_ = 0;
};

}  // namespace retrace
