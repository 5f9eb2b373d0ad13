// Scripts and style are the same in every report; the pages that the targets draw have none.
#include "report/assets.hpp"

namespace retrace::assets {

std::string_view style() {
  return "";
}
std::string_view chart_js() {
  return "";
}
std::string_view chart_js_licence() {
  return "";
}
std::string_view charts() {
  return "";
}
std::string_view matrix() {
  return "";
}
std::string_view strip() {
  return "";
}
std::string_view player() {
  return "";
}
std::string_view report() {
  return "";
}

}  // namespace retrace::assets
