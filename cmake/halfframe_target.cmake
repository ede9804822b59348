# Flags that every target of ours has, and the one way to add a library of a room.

# Products are never contracted to fused multiply-adds: pictures and figures must not depend on the compiler's mood.
set(HALFFRAME_FLAGS -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wno-missing-field-initializers  # designated initialisers leave the defaults out on purpose
    -Wno-restrict)                   # GCC 12 sees overlaps in std::string that are not there (GCC bug 105651)

# For what asks and judges but does not compute (tests, subcommands): a third less to compile than with -O3.
set(HALFFRAME_LIGHT_FLAGS $<$<CONFIG:Release>:-O1>)

# What most files of a library read is parsed once: it is 40 % of the time that one of them takes to compile. An object
# library lends it to all, made with their flags, because only then the compiler takes it.
add_library(halfframe_library_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_compile_options(halfframe_library_headers PRIVATE ${HALFFRAME_FLAGS})
target_include_directories(halfframe_library_headers SYSTEM PRIVATE ${GLM_INCLUDE_DIR})
target_link_libraries(halfframe_library_headers PRIVATE fmt::fmt)
target_precompile_headers(halfframe_library_headers PRIVATE <fmt/format.h> <glm/glm.hpp> <algorithm> <array> <cmath>
  <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <span> <sstream> <string> <string_view>
  <unordered_map> <utility> <variant> <vector>)

# halfframe_library(ROOM SOURCES ... PUBLIC ... PRIVATE ...): a static library halfframe_ROOM, alias halfframe::ROOM.
function(halfframe_library room)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(halfframe_${room} STATIC ${ARG_SOURCES})
  add_library(halfframe::${room} ALIAS halfframe_${room})
  set_target_properties(halfframe_${room} PROPERTIES EXPORT_NAME ${room})
  target_compile_features(halfframe_${room} PUBLIC cxx_std_20)
  target_compile_options(halfframe_${room} PRIVATE ${HALFFRAME_FLAGS})
  target_include_directories(halfframe_${room} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/halfframe>)
  target_include_directories(halfframe_${room} SYSTEM PRIVATE ${GLM_INCLUDE_DIR} ${GLES3_INCLUDE_DIR})
  target_link_libraries(halfframe_${room} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(fmt::fmt IN_LIST ARG_PRIVATE)  # the others have few files
    target_precompile_headers(halfframe_${room} REUSE_FROM halfframe_library_headers)
  endif()
endfunction()

