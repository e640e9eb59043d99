# kaustik_version: a small library for core/version.h with the release and the build id (git describe). Only its one generated
# source is compiled again when the id changes, so a commit costs one file and a link.
set(version_source ${PROJECT_BINARY_DIR}/generated/version.cpp)
set(version_arguments
  -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DTEMPLATE=${PROJECT_SOURCE_DIR}/cmake/version.cpp.in
  -DOUTPUT=${version_source} -P ${PROJECT_SOURCE_DIR}/cmake/WriteVersion.cmake)
execute_process(COMMAND ${CMAKE_COMMAND} ${version_arguments})
add_custom_target(kaustik_version_source
  COMMAND ${CMAKE_COMMAND} ${version_arguments} BYPRODUCTS ${version_source} VERBATIM)
add_library(kaustik_version STATIC ${version_source})
add_dependencies(kaustik_version kaustik_version_source)
target_link_libraries(kaustik_version PUBLIC kaustik_options)
