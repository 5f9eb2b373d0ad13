# Writes a C++ source that holds text files as strings:
#   cmake -DOUTPUT=assets.cpp "-DFILES=name=path;name=path" -P embed.cmake
# Each becomes `std::string_view name()` of namespace retrace::assets, see assets.hpp.
set(source "#include \"report/assets.hpp\"\n\nnamespace retrace::assets {\n")
foreach(entry IN LISTS FILES)
  string(REGEX MATCH "^([a-z_]+)=(.*)$" matched "${entry}")
  set(name "${CMAKE_MATCH_1}")
  file(READ "${CMAKE_MATCH_2}" text)
  string(APPEND source "\nstd::string_view ${name}() {\n  return R\"embedded(${text})embedded\";\n}\n")
endforeach()
string(APPEND source "\n}  // namespace retrace::assets\n")
file(WRITE "${OUTPUT}" "${source}")
