#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace vo {

/// Bad input from outside the program: a file, a stream, a setting of the user.
///
/// The message is one line made of three parts: where (a path, a field, a row), what is wrong there with the
/// offending value, and what was expected instead. A broken precondition between functions of the libraries
/// is `std::invalid_argument`, not this.
class Error : public std::runtime_error {
 public:
  /// Composes "where: what" or, with an expectation, "where: what; expected expectation". Line breaks in any
  /// part become spaces, so that the message stays on one line.
  Error(std::string_view where, std::string_view what, std::string_view expectation = {});
};

}  // namespace vo
