# What `cmake --install` puts where, and the package that find_package(lobe) finds. The rooms install their own headers
# (LobeRoom.cmake). Everything is found relative to the package or the program, so that the prefix can move.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lobe)
get_property(rooms GLOBAL PROPERTY LOBE_ROOMS)

install(TARGETS lobe lobe-check lobe-view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS lobe-image-worker lobe-scene-worker lobe-check-worker RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/lobe)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/shaders/glsl DESTINATION ${CMAKE_INSTALL_DATADIR}/lobe
        FILES_MATCHING PATTERN "*.glsl" PATTERN "*.vert" PATTERN "*.frag")
# The gallery of lobe-view.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/lobe
        PATTERN "making" EXCLUDE PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ${LOBE_PAGE_BUILT} DESTINATION ${CMAKE_INSTALL_DATADIR}/lobe)

set_target_properties(lobe_compile PROPERTIES EXPORT_NAME compile)
install(TARGETS ${rooms} lobe_compile EXPORT lobe ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lobe NAMESPACE lobe:: FILE lobeTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/lobeConfig.cmake.in ${CMAKE_BINARY_DIR}/lobeConfig.cmake
                              INSTALL_DESTINATION ${package_dir} PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_DATADIR CMAKE_INSTALL_LIBEXECDIR)
# Before 1.0 a new minor version may change any interface.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/lobeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/lobeConfig.cmake ${CMAKE_BINARY_DIR}/lobeConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/LobeOpenImageIO.cmake ${CMAKE_CURRENT_LIST_DIR}/LobeShaderTests.cmake ${CMAKE_CURRENT_LIST_DIR}/lobe_place.cpp.in
        DESTINATION ${package_dir})
