#include "io/decoder_errors.hpp"

#include <cstdarg>
#include <mutex>
#include <set>
#include <string_view>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/log.h>
}

namespace vo {
namespace {

/// The counters there are. FFmpeg has one log for all decoders, others' too, whose `opaque` is not ours.
struct Registry {
  std::mutex mutex;
  std::set<void*> counters;
};

Registry& registry() {
  static auto& only = *new Registry;  // decoders may log while the program ends
  return only;
}

void on_log(void* object, int level, const char* format, va_list /*arguments*/) {
  // What is concealed is told as news, not as an error.
  const bool wrong = level <= AV_LOG_ERROR || std::string_view(format).starts_with("concealing");
  if (!wrong || object == nullptr) return;
  if (*static_cast<const AVClass**>(object) != avcodec_get_class()) return;
  void* const key = static_cast<const AVCodecContext*>(object)->opaque;
  const std::scoped_lock lock(registry().mutex);
  if (registry().counters.contains(key)) static_cast<DecoderErrors*>(key)->add();
}

}  // namespace

DecoderErrors::DecoderErrors() {
  av_log_set_callback(on_log);
  const std::scoped_lock lock(registry().mutex);
  registry().counters.insert(this);
}

DecoderErrors::~DecoderErrors() {
  const std::scoped_lock lock(registry().mutex);
  registry().counters.erase(this);
}

}  // namespace vo
