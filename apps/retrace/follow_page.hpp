#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/certainty/follower.hpp>
#include <place/route/route.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {

/// Width of the pictures on the pages of a followed walk, as previews of a route.
inline constexpr int kFollowPicture_px = 160;

/// A small JPEG of a frame, in colour where it has colours.
std::vector<std::uint8_t> follow_picture(const vo::Frame& frame);

/// The traverse that a followed place is on. Throws `std::invalid_argument` if the route has none of the
/// name.
std::size_t traverse_of(const place::FollowedPlace& at, const place::Route& route);

/// What player.js draws of a route: its traverses with their poses, and its named places.
nlohmann::ordered_json player_route(const place::Route& route);

/// A moment of a walk as player.js reads it, but for the picture of the place. `jpeg`: what is seen.
nlohmann::ordered_json player_moment(const place::Position& position, const std::vector<std::uint8_t>& jpeg,
                                     const place::Route& route);

/// As text; whatever is not UTF-8 in it is replaced.
std::string player_text(const nlohmann::ordered_json& json);

}  // namespace retrace
