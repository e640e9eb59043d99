# Writes OUTPUT from TEMPLATE with VERSION and BUILD_ID; leaves it untouched if nothing changed.
set(BUILD_ID "")
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM)
  execute_process(COMMAND ${GIT_PROGRAM} describe --always --dirty --tags
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE BUILD_ID ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(NOT BUILD_ID)
  set(BUILD_ID "unknown")
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
