# lobe_add_shader_tests(NAME
#     SOURCES FILE... | FOLDERS DIR...   test files; folders whose *_test.glsl are all tests (docs/lobe_check.md)
#     [BACKENDS NAME...]                 egl, osmesa, glfw, auto; one CTest test each, NAME.BACKEND [auto]
#     [INCLUDE_DIRECTORIES DIR...]       where includes are looked for, after the including file's folder
#     [FILTER REGEX] [TAGS TAG...]       only some of the tests
#     [INPUTS N] [SEED N]                of random inputs, in place of what the files say
#     [TIMEOUT SECONDS]                  of all tests on one backend [300]
#     [LABELS LABEL...]                  for ctest -L
#     [JUNIT]                            writes NAME.BACKEND.xml to the current binary folder
#     [SKIP_MISSING_BACKENDS])           a backend that the machine lacks is skipped; otherwise it fails
#
# Adds tests that run lobe-check. The project needs no language enabled. Relative paths are the current source folder's.
function(lobe_add_shader_tests name)
  set(flags JUNIT SKIP_MISSING_BACKENDS)
  set(single FILTER INPUTS SEED TIMEOUT)
  set(multiple SOURCES FOLDERS BACKENDS INCLUDE_DIRECTORIES TAGS LABELS)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "${flags}" "${single}" "${multiple}")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "lobe_add_shader_tests(${name}): '${ARG_UNPARSED_ARGUMENTS}' not known; expected one of "
                        "${flags};${single};${multiple}")
  endif()
  set(command $<TARGET_FILE:lobe::check>)
  foreach(path IN LISTS ARG_SOURCES ARG_FOLDERS)
    cmake_path(ABSOLUTE_PATH path BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    if(NOT EXISTS ${path})
      message(FATAL_ERROR "lobe_add_shader_tests(${name}): ${path} does not exist")
    endif()
    list(APPEND command ${path})
  endforeach()
  if(NOT ARG_SOURCES AND NOT ARG_FOLDERS)
    message(FATAL_ERROR "lobe_add_shader_tests(${name}): no SOURCES and no FOLDERS")
  endif()
  foreach(folder IN LISTS ARG_INCLUDE_DIRECTORIES)
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND command -I ${folder})
  endforeach()
  foreach(tag IN LISTS ARG_TAGS)
    list(APPEND command --tag ${tag})
  endforeach()
  foreach(option FILTER INPUTS SEED)
    if(DEFINED ARG_${option})
      string(TOLOWER ${option} flag)
      list(APPEND command --${flag} ${ARG_${option}})
    endif()
  endforeach()
  if(NOT ARG_BACKENDS)
    set(ARG_BACKENDS auto)
  endif()
  if(NOT DEFINED ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  foreach(backend IN LISTS ARG_BACKENDS)
    set(report "")
    if(ARG_JUNIT)
      set(report --junit ${CMAKE_CURRENT_BINARY_DIR}/${name}.${backend}.xml)
    endif()
    add_test(NAME ${name}.${backend} COMMAND ${command} --backend ${backend} --no-color ${report})
    set_tests_properties(${name}.${backend} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}")
    if(ARG_SKIP_MISSING_BACKENDS)
      set_tests_properties(${name}.${backend} PROPERTIES SKIP_RETURN_CODE 4)  # no context (docs/exit_codes.md)
    endif()
  endforeach()
endfunction()
