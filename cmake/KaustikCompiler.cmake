# Compiler settings shared by every target, as one interface library.
add_library(kaustik_options INTERFACE)
target_include_directories(kaustik_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(kaustik_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  # The same source must give the same bits in every build: no contraction into FMA, no fast-math.
  # Not setting errno changes no result and lets sqrt be one instruction.
  -ffp-contract=off -fno-fast-math -fno-math-errno)
# GCC collects garbage when its heap exceeds 128 MiB, which the precompiled headers alone fill. A threshold of 512 MiB
# saves a tenth to a fifth of the time of most sources, for a tenth more memory.
target_compile_options(kaustik_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
if(KAUSTIK_WARNINGS_AS_ERRORS)
  # GCC 12 wrongly reports overlapping copies inside std::string's operator+ (its bug 105329).
  target_compile_options(kaustik_options INTERFACE -Werror $<$<CXX_COMPILER_ID:GNU>:-Wno-error=restrict>)
endif()

# KAUSTIK_SANITIZE: comma-separated sanitizers, e.g. "address,undefined". The first undefined behaviour ends the program, so
# that a test fails on it. Sanitizers check more than the fortified functions do, and do not see through them.
if(KAUSTIK_SANITIZE)
  target_compile_options(kaustik_options INTERFACE
    -fsanitize=${KAUSTIK_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(kaustik_options INTERFACE -fsanitize=${KAUSTIK_SANITIZE})
else()
  include(KaustikHardening)
endif()

# The same commit gives the same files in whatever folder it is built: names of sources in messages, and in the debug
# information, begin at the root of the tree. scripts/check-reproducible compares two builds.
target_compile_options(kaustik_options INTERFACE
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}=. -ffile-prefix-map=${PROJECT_BINARY_DIR}=./build)

# ccache keeps objects that were compiled with a precompiled header only if it is told to trust what it cannot see: macros
# of the header (they come from the same command line), time stamps, and __TIME__, which no source uses. GCC must leave the
# name of the header in the preprocessed text.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE_PROGRAM})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(kaustik_options INTERFACE -fpch-preprocess)
  endif()
endif()
