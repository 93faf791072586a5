# A room is one folder of engine/ and one library, lobe::NAME. It sees the headers of the rooms that it names and no
# others: each room's include directory holds a single link, to that room's folder, so a wrong include does not build.
function(lobe_room name)
  cmake_parse_arguments(ARG "" "" "USES;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(view ${CMAKE_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${view})
  file(CREATE_LINK ${folder} ${view}/${name} SYMBOLIC)

  if(NOT sources)
    message(FATAL_ERROR "room ${name} has no sources")
  endif()
  add_library(lobe_${name} STATIC ${sources})
  add_library(lobe::${name} ALIAS lobe_${name})
  set_target_properties(lobe_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(lobe_${name} PUBLIC
    $<BUILD_INTERFACE:${view}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lobe>)
  target_link_libraries(lobe_${name} PUBLIC lobe_compile ${ARG_LIBRARIES} PRIVATE ${ARG_PRIVATE_LIBRARIES})
  lobe_precompile(lobe_${name} lobe_precompiled_rooms)
  foreach(room IN LISTS ARG_USES)
    target_link_libraries(lobe_${name} PUBLIC lobe_${room})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY LOBE_ROOMS lobe_${name})
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lobe FILES_MATCHING PATTERN "*.hpp")
endfunction()
