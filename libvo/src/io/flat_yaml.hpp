#pragma once

#include "vo/io/text_file.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vo {

/// A settings file of YAML, its nested keys joined by points: `cam0.intrinsics` -> `[500, 500, 320, 240]`.
using FlatYaml = std::map<std::string, std::string>;

/// Reads the YAML that people write settings in: keys with scalars, nested by indentation; lists in brackets,
/// over several lines too, or of `- ` lines; quotes, tags and comments. Not read: anchors, maps in braces,
/// text over several lines. What is none of it is skipped, as are keys whose path is longer than
/// 64 bytes, and those after the first thousand.
FlatYaml read_flat_yaml(const std::vector<TextLine>& lines);

/// The numbers of a scalar or a list, of lists too; none if something in it is no number.
std::optional<std::vector<double>> numbers_of(const std::string& value);

}  // namespace vo
