# Headers of others that most files include, parsed once instead of some hundred times: a full build takes a third less.
# None of ours: a change of one would rebuild all. Nor CLI11: its constants would be made in each file, at 17 s each. Off
# with the clang preset, so that each file still names what it uses.
option(LOBE_PRECOMPILED_HEADERS "Parse standard, GLM, JSON and GoogleTest headers once" ON)

set(LOBE_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <map> <memory> <numeric>
    <optional> <set> <span> <sstream> <string> <string_view> <utility> <vector> <glm/glm.hpp> <nlohmann/json.hpp>)

# What spends no time that counts, the reading of command lines and tests that compute little, is compiled for a short build.
# Not under sanitizers, whose preset says how.
if(LOBE_SANITIZE)
  set(LOBE_LIGHT_OPTIONS "")
  set(LOBE_PLAIN_TEST_OPTIONS -O0)
else()
  set(LOBE_LIGHT_OPTIONS $<$<CONFIG:Release>:-O1>)
  set(LOBE_PLAIN_TEST_OPTIONS $<$<CONFIG:Release>:-O0>)
endif()

# GCC 12 sees copies of texts that are longer than memory, and no longer takes them for the library's where its headers
# were parsed before (GCC bugs 105329, 105651).
function(lobe_quiet_library_warnings target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE
      $<$<COMPILE_LANGUAGE:CXX>:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>)
  endif()
endfunction()

# lobe_precompiled(NAME library|program [OPTIONS ...] [LIBRARIES ...] [HEADERS ...]): headers for lobe_precompile(). What they
# were parsed with must be what they are used with: options, and -fPIC of libraries or -fPIE of programs.
function(lobe_precompiled name kind)
  if(NOT LOBE_PRECOMPILED_HEADERS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "OPTIONS;LIBRARIES;HEADERS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
  if(kind STREQUAL "library")
    file(WRITE ${source} "// Holds precompiled headers.\n")
    add_library(${name} OBJECT ${source})
  else()
    file(WRITE ${source} "int main() {}\n")
    add_executable(${name} ${source})
  endif()
  target_link_libraries(${name} PRIVATE lobe_compile glm::glm nlohmann_json::nlohmann_json ${ARG_LIBRARIES})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${LOBE_COMMON_HEADERS} ${ARG_HEADERS})
endfunction()

# Compiles `target` with the options of `headers`, which is `name` of the above, and takes its headers.
function(lobe_precompile target headers)
  if(headers STREQUAL "lobe_precompiled_programs")
    target_compile_options(${target} PRIVATE ${LOBE_LIGHT_OPTIONS})
  elseif(headers STREQUAL "lobe_precompiled_tests")
    target_compile_options(${target} PRIVATE ${LOBE_PLAIN_TEST_OPTIONS})
  endif()
  if(LOBE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${headers})
    lobe_quiet_library_warnings(${target})
  endif()
endfunction()

lobe_precompiled(lobe_precompiled_rooms library)
lobe_precompiled(lobe_precompiled_programs library OPTIONS ${LOBE_LIGHT_OPTIONS})

# After GTest was found.
function(lobe_make_test_headers)
  set(gtest LIBRARIES GTest::gtest GTest::gmock HEADERS <gmock/gmock.h> <gtest/gtest.h>)
  lobe_precompiled(lobe_precompiled_tests program OPTIONS ${LOBE_PLAIN_TEST_OPTIONS} ${gtest})
  lobe_precompiled(lobe_precompiled_computing_tests program ${gtest})
endfunction()
