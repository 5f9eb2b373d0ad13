#include "arguments.hpp"

#include "settings_file.hpp"

#include <cstdint>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

std::string type_of(const place::Setting& setting) {
  if (!setting.choices.empty()) {
    std::string names(setting.choices);
    std::ranges::replace(names, '|', ',');
    return "{" + names + "}";
  }
  if (!setting.form.empty()) return std::string(setting.form);
  return std::visit(
      [](auto field) -> std::string {
        using Value =
            typename std::remove_cvref_t<decltype(std::declval<place::Settings>().*field)>::value_type;
        if (std::is_same_v<Value, bool>) return "true|false";
        if (std::is_same_v<Value, std::string>) return "FILE";
        return std::is_same_v<Value, int> ? "INT" : "NUMBER";
      },
      setting.field);
}

}  // namespace

Argument& Argument::required() {
  option_->required();
  return *this;
}
Argument& Argument::optional() {
  option_->required(false);
  return *this;
}
Argument& Argument::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}
Argument& Argument::non_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}
Argument& Argument::range(double least, double most) {
  option_->check(CLI::Range(least, most));
  return *this;
}
Argument& Argument::existing_file() {
  option_->check(CLI::ExistingFile);
  return *this;
}
Argument& Argument::comma_separated() {
  option_->delimiter(',');
  return *this;
}
Argument& Argument::count(int least, int most) {
  option_->expected(least, most);
  return *this;
}
Argument& Argument::group(const std::string& name) {
  option_->group(name);
  return *this;
}
Argument& Argument::excludes(const Argument& other) {
  option_->excludes(other.option_);
  return *this;
}
Argument& Argument::needs(const Argument& other) {
  option_->needs(other.option_);
  return *this;
}

Arguments::Arguments(CLI::App& app, bool all) : app_(app), all_(all) {}

template <typename T>
Argument Arguments::positional(const std::string& name, T& target, const std::string& description) {
  return Argument(app_.add_option(name, target, description)->required());
}

template <typename T>
Argument Arguments::option(const std::string& flag, T& target, const std::string& description) {
  return Argument(app_.add_option(flag, target, description)->capture_default_str());
}

template Argument Arguments::positional(const std::string&, std::string&, const std::string&);
template Argument Arguments::positional(const std::string&, std::vector<std::string>&, const std::string&);
template Argument Arguments::option(const std::string&, std::string&, const std::string&);
template Argument Arguments::option(const std::string&, int&, const std::string&);
template Argument Arguments::option(const std::string&, std::size_t&, const std::string&);
template Argument Arguments::option(const std::string&, double&, const std::string&);
template Argument Arguments::option(const std::string&, std::optional<double>&, const std::string&);
template Argument Arguments::option(const std::string&, std::optional<std::size_t>&, const std::string&);
template Argument Arguments::option(const std::string&, std::vector<std::string>&, const std::string&);
template Argument Arguments::option(const std::string&, std::vector<std::size_t>&, const std::string&);

Argument Arguments::flag(const std::string& name, bool& target, const std::string& description) {
  return Argument(app_.add_flag(name, target, description));
}

void Arguments::rare(const Argument& argument) {
  if (!all_) argument.option_->group("");
}

Argument Arguments::named_choice(const std::string& flag, const std::vector<std::string>& names,
                                 const std::string& current, std::function<void(const std::string&)> take,
                                 const std::string& description) {
  return Argument(app_.add_option_function<std::string>(flag, std::move(take), description)
                      ->default_str(current)
                      ->check(CLI::IsMember(names))
                      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast));
}

void Arguments::exactly_one(std::initializer_list<Argument> arguments) {
  CLI::Option_group* group = app_.add_option_group("one of");
  for (const Argument& argument : arguments) group->add_option(argument.option_);
  group->require_option(1);
}

void Arguments::setting(place::Settings& target, const place::Setting& setting) {
  const std::string type = type_of(setting);
  CLI::Option* option = app_.add_option_function<std::string>(
      fmt::format("--{}", setting.name),
      [&target, &setting](const std::string& text) {
        try {
          place::set(target, setting, text);
        } catch (const vo::Error& error) {
          throw CLI::ValidationError("--" + std::string(error.what()));
        }
      },
      std::string(setting.description));
  option->type_name(type)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  if (!setting.standard.empty()) option->default_str(std::string(setting.standard));
  option->group(setting.everyday || all_ ? std::string(place::name_of(setting.group)) : std::string());
}

void Arguments::settings(place::Settings& target, std::initializer_list<place::SettingGroup> groups,
                         const std::vector<std::string>& without) {
  settings_ = &target;
  for (const place::Setting& entry : place::settings_table()) {
    if (std::ranges::find(groups, entry.group) == groups.end()) continue;
    if (std::ranges::find(without, entry.name) == without.end()) setting(target, entry);
  }
  app_.add_option("--config", config_, "TOML file of settings; flags come on top")->group("General");
}

void Arguments::force(CommonOptions& target) {
  app_.add_flag("--force", target.force, "overwrite what is there")->group("General");
}

void Arguments::json(CommonOptions& target) {
  app_.add_flag("--json", target.json, "print the result as JSON")->group("General");
}

void Arguments::common(CommonOptions& target) {
  force(target);
  json(target);
}

void Arguments::footer(const std::string& text) {
  app_.footer(settings_ != nullptr && !all_ ? "--help-all shows every setting.\n" + text : text);
}

void Arguments::finish() {
  if (settings_ != nullptr && !config_.empty())
    *settings_ = place::merged(*settings_, read_settings_file(config_));
}

}  // namespace retrace
