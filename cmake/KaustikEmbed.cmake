# kaustik_embed(<target> <header> <namespace> NAME FILE [NAME FILE ...]): embeds each file as a std::string_view of that name,
# in a source that the build writes and a header (included as <header>) beside it. A changed file is embedded again.
function(kaustik_embed target header namespace)
  set(folder ${PROJECT_BINARY_DIR}/generated)
  cmake_path(REPLACE_EXTENSION header LAST_ONLY .cpp OUTPUT_VARIABLE source)
  set(files ${ARGN})
  set(declarations "")
  set(inputs "")
  while(files)
    list(POP_FRONT files name file)
    string(APPEND declarations "extern const std::string_view ${name};\n")
    list(APPEND inputs ${file})
  endwhile()
  file(CONFIGURE OUTPUT ${folder}/${header} @ONLY CONTENT
"#pragma once
// Files that the build embeds (cmake/KaustikEmbed.cmake).

#include <string_view>

namespace ${namespace} {

${declarations}
}  // namespace ${namespace}
")
  add_custom_command(OUTPUT ${folder}/${source}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${folder}/${source} -DHEADER=${header} -DNAMESPACE=${namespace}
      "-DFILES=${ARGN}" -P ${PROJECT_SOURCE_DIR}/cmake/WriteEmbedded.cmake
    DEPENDS ${inputs} ${PROJECT_SOURCE_DIR}/cmake/WriteEmbedded.cmake VERBATIM)
  target_sources(${target} PRIVATE ${folder}/${source})
  target_include_directories(${target} PUBLIC ${folder})
endfunction()
