#include "imu_steps.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>
#include <vo/gait/acceleration_steps.hpp>
#include <vo/io/video_acceleration.hpp>

namespace retrace {

std::size_t imu_steps(const std::string& source, const vo::Walk& walk) {
  if (source != "video") throw vo::Error("--imu", "is '" + source + "'", "video");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(walk.source, ignored))
    throw vo::Error("--imu video", fmt::format("is given for {}", walk.source), "a walk of one video file");
  const vo::VideoAcceleration recorded = vo::read_video_acceleration(walk.source);
  if (recorded.damaged > 0)
    spdlog::warn("{}: {} pieces of its accelerometer track are damaged and left out", walk.source,
                 recorded.damaged);
  return vo::acceleration_steps(recorded.acceleration_m_s2, recorded.time_s).size();
}

}  // namespace retrace
