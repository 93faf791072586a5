# Headers of others that most files include, parsed once instead of some hundred times: a full build takes a third less.
# None of ours: a change of one would rebuild all. Nor CLI11: its constants would be made in each file, at 17 s each. Off
# with the clang preset, so that each file still names what it uses.
option(LOBE_PRECOMPILED_HEADERS "Parse standard, GLM, JSON and GoogleTest headers once" ON)

set(LOBE_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <map> <memory> <numeric>
    <optional> <set> <span> <sstream> <string> <string_view> <utility> <vector> <glm/glm.hpp> <nlohmann/json.hpp>)

# What a header was parsed with must be what it is used with; libraries (-fPIC) and programs (-fPIE) differ.
if(LOBE_PRECOMPILED_HEADERS)
  file(WRITE ${CMAKE_BINARY_DIR}/generated/precompiled_library.cpp "// Holds the precompiled headers of libraries.\n")
  file(WRITE ${CMAKE_BINARY_DIR}/generated/precompiled_tests.cpp "int main() {}\n")
  add_library(lobe_precompiled OBJECT ${CMAKE_BINARY_DIR}/generated/precompiled_library.cpp)
  target_link_libraries(lobe_precompiled PRIVATE lobe_compile glm::glm nlohmann_json::nlohmann_json)
  target_precompile_headers(lobe_precompiled PRIVATE ${LOBE_COMMON_HEADERS})
endif()

# GCC 12 sees copies of texts that are longer than memory, and no longer takes them for the library's where its headers
# were parsed before (GCC bugs 105329, 105651).
function(lobe_quiet_library_warnings target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE
      $<$<COMPILE_LANGUAGE:CXX>:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>)
  endif()
endfunction()

function(lobe_precompile target)
  if(LOBE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM lobe_precompiled)
    lobe_quiet_library_warnings(${target})
  endif()
endfunction()

# After GTest was found.
function(lobe_make_test_headers)
  if(LOBE_PRECOMPILED_HEADERS)
    add_executable(lobe_precompiled_tests ${CMAKE_BINARY_DIR}/generated/precompiled_tests.cpp)
    target_link_libraries(lobe_precompiled_tests PRIVATE lobe_compile glm::glm nlohmann_json::nlohmann_json GTest::gtest GTest::gmock)
    target_precompile_headers(lobe_precompiled_tests PRIVATE ${LOBE_COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
  endif()
endfunction()

function(lobe_precompile_tests target)
  if(LOBE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM lobe_precompiled_tests)
    lobe_quiet_library_warnings(${target})
  endif()
endfunction()
