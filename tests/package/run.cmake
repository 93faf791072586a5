# Installs the build to a prefix, uses it as a stranger would, and shows that the prefix's own files are the ones used.
# Needs BUILD_DIR, SOURCE_DIR (of this folder), WORK_DIR, CXX, GENERATOR.
cmake_minimum_required(VERSION 3.25)

set(prefix ${WORK_DIR}/prefix)
set(picture ${WORK_DIR}/out/triangle.png)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR}/out)
foreach(variable LOBE_SHADER_DIR LOBE_WORKER_DIR LOBE_PAGE_DIR)
  unset(ENV{${variable}})
endforeach()

# Runs a command from the root folder; its exit code must be EXPECTED.
function(run expected)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY / RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code STREQUAL expected)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: exit code ${code}, expected ${expected}\n${out}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

function(must_contain text)
  string(FIND "${output}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "expected '${text}' in:\n${output}")
  endif()
endfunction()

run(0 ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

# A program outside the project, which is not beside the installed files.
run(0 ${CMAKE_COMMAND} -S ${SOURCE_DIR}/consumer -B ${WORK_DIR}/consumer -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release)
run(0 ${CMAKE_COMMAND} --build ${WORK_DIR}/consumer)
run(0 ${WORK_DIR}/consumer/consumer)
must_contain("shaders ${prefix}/")
must_contain("worker ${prefix}/")
must_contain("page ${prefix}/")
if(NOT EXISTS ${prefix}/share/lobe/page/chart.min.js)
  message(FATAL_ERROR "the chart library is not installed")
endif()

# The installed program, on a scene with an image, so that both workers are needed.
set(render ${prefix}/bin/lobe render ${SOURCE_DIR}/triangle.gltf -o ${picture} --resolution 64x48)
run(0 ${prefix}/bin/lobe --version)
run(0 ${prefix}/bin/lobe info)
run(0 ${render})
if(NOT EXISTS ${picture})
  message(FATAL_ERROR "no picture at ${picture}:\n${output}")
endif()

# The example of shader tests: a project without a language, whose tests run on the installed lobe-check.
set(example ${WORK_DIR}/shader_tests)
file(COPY ${SOURCE_DIR}/../../docs/examples/shader_tests DESTINATION ${WORK_DIR})
set(test_example ${CMAKE_CTEST_COMMAND} --test-dir ${example}/build --output-on-failure)
run(0 ${CMAKE_COMMAND} -S ${example} -B ${example}/build -DCMAKE_PREFIX_PATH=${prefix})
run(0 ${test_example})
must_contain("100% tests passed")
if(NOT EXISTS ${example}/build/colour.auto.xml)
  message(FATAL_ERROR "no JUnit report:\n${output}")
endif()
# Without any backend tests are skipped where that was asked for, and fail where not.
set(no_backends LOBE_EGL_LIBRARY=/nowhere LOBE_OSMESA_LIBRARY=/nowhere LOBE_GLFW_LIBRARY=/nowhere)
run(0 ${CMAKE_COMMAND} -E env ${no_backends} ${test_example} -R "colour.(egl|osmesa)")
must_contain("Skipped")
run(8 ${CMAKE_COMMAND} -E env ${no_backends} ${test_example} -R colour.auto)
# A fault is found.
file(READ ${example}/colour.glsl text)
string(REPLACE "1.0 / 2.4" "1.0 / 2.41" text "${text}")
file(WRITE ${example}/colour.glsl "${text}")
run(8 ${test_example} -R colour.auto)
must_contain("round_trip")

# With a fault in the prefix's files it must fail: else it read those of the source tree.
file(GLOB_RECURSE shaders ${prefix}/share/lobe/glsl/*)
foreach(shader IN LISTS shaders)
  file(APPEND ${shader} "\n#error installed\n")
endforeach()
run(5 ${render})
must_contain("installed")
file(REMOVE_RECURSE ${prefix}/libexec/lobe)
file(MAKE_DIRECTORY ${prefix}/libexec/lobe)
foreach(worker lobe-image-worker lobe-scene-worker)
  file(WRITE ${prefix}/libexec/lobe/${worker} "#!/bin/sh\nexit 1\n")
  file(CHMOD ${prefix}/libexec/lobe/${worker} PERMISSIONS OWNER_READ OWNER_EXECUTE)
endforeach()
run(3 ${render})

file(REMOVE_RECURSE ${WORK_DIR})
