#include "match/shard_request.hpp"

#include "match/messages.hpp"
#include "route/descriptor_rows.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace place {
namespace {

void put_text(MessageWriter& message, std::string_view text) {
  message.put_all(std::span(text.data(), text.size()));
}

std::string get_text(MessageReader& message) {
  const std::vector<char> text = message.get_all<char>();
  return {text.begin(), text.end()};
}

}  // namespace

Team::Message message_of(const ShardRequest& request) {
  MessageWriter message;
  message.put(request.task);
  for (const Setting& setting : settings_table()) {
    const std::optional<std::string> value = text_of(request.settings, setting);
    message.put(value.has_value());
    if (value) put_text(message, *value);
  }
  message.put(request.route_digest.has_value());
  message.put(request.route_digest.value_or(0));
  message.put(request.traverse);
  message.put(request.query.size());
  for (const Descriptors& query : request.query) {
    const descriptor_rows::Form form = descriptor_rows::form_of(query);
    put_text(message, form.name);
    message.put(form.width);
    message.put(form.height);
    message.put(count_of(query));
    message.put_all(descriptor_rows::bytes_of(query));
  }
  message.put_all(request.columns);
  message.put(request.search.sequence);
  message.put(request.search.graph);
  message.put_all(request.search.path.steps);
  message.put_all(request.search.gaps.query);
  message.put_all(request.search.gaps.reference);
  return message.bytes();
}

ShardRequest read_request(const Team::Message& message) {
  MessageReader reader(message);
  ShardRequest request;
  request.task = reader.get<ShardRequest::Task>();
  for (const Setting& setting : settings_table())
    if (reader.get<bool>()) set(request.settings, setting, get_text(reader));
  const bool has_digest = reader.get<bool>();
  const auto digest = reader.get<std::int64_t>();
  if (has_digest) request.route_digest = digest;
  request.traverse = reader.get<std::size_t>();
  for (auto left = reader.get<std::size_t>(); left > 0; --left) {
    const std::string form = get_text(reader);
    const auto width = reader.get<std::int64_t>(), height = reader.get<std::int64_t>();
    std::optional<Descriptors> made =
        descriptor_rows::make_of_form(form, width, height, reader.get<std::size_t>());
    const std::vector<std::uint8_t> bytes = reader.get_all<std::uint8_t>();
    if (!made || descriptor_rows::bytes_of(*made).size() != bytes.size())
      throw std::logic_error("a message of a search holds no descriptors");
    std::ranges::copy(bytes, descriptor_rows::bytes_of(*made).begin());
    request.query.push_back(std::move(*made));
  }
  request.columns = reader.get_all<std::size_t>();
  request.search.sequence = reader.get<SequenceSearchOptions>();
  request.search.graph = reader.get<GraphSearchOptions>();
  request.search.path.steps = reader.get_all<double>();
  request.search.gaps.query = reader.get_all<std::size_t>();
  request.search.gaps.reference = reader.get_all<std::size_t>();
  return request;
}

}  // namespace place
