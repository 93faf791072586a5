# The parts of report.html, ours and the chart library, in one folder of the build tree, which is also what is installed:
# an installed program does not depend on where the library was found.
find_file(LOBE_CHART_JS chart.js/chart.min.js PATHS /usr/share/javascript REQUIRED)
set(LOBE_PAGE_BUILT ${CMAKE_BINARY_DIR}/page)
file(GLOB page_parts CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/engine/measure/page/*)
foreach(part IN LISTS page_parts LOBE_CHART_JS)
  get_filename_component(name ${part} NAME)
  configure_file(${part} ${LOBE_PAGE_BUILT}/${name} COPYONLY)
endforeach()
