# What every target of ours is compiled with.
add_library(lobe_compile INTERFACE)
target_compile_features(lobe_compile INTERFACE cxx_std_20)
target_compile_options(lobe_compile INTERFACE
  $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wnon-virtual-dtor;-Wold-style-cast;-Woverloaded-virtual;-Wformat=2;-Wimplicit-fallthrough>>)
# Clang also warns of double{x}, which is how we say that we mean it.
target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wdouble-promotion>>)
# GCC 12 warns of overlaps that are not there when texts are put together with + (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>>)
endif()
# GCC 12 takes pairs of double -> float -> double for nothing to do where it puts statements side by side into a vector:
# 0.1 rounded to a float stays 0.1 (tests/math/rounding_test.cpp). Vectors made of loops are not concerned.
target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>>)
# The same formula must give the same bits whichever compiler inlines it: twins and camera matrices are compared.
target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
# As ccache wants it where headers are precompiled.
target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>>)
if(LOBE_WARNINGS_AS_ERRORS)
  target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(LOBE_SANITIZE)
  # GCC takes what <regex> moves for uninitialised once sanitizers have taken its code apart (GCC bug 105562).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(lobe_compile INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>>)
  endif()
  add_compile_options(-fsanitize=${LOBE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LOBE_SANITIZE})
endif()
