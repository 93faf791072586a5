# Debian 12's OpenImageIO names OpenCV's header folder without depending on the package that has it; CMake refuses a
# target with a folder that does not exist.
find_package(OpenImageIO REQUIRED)
get_target_property(folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER folders EXCLUDE REGEX "opencv")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${folders}")
