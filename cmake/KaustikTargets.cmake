# kaustik_precompile(<target> <header>): compiles the target's sources with the precompiled cmake/<header>. The first
# target that names a header, the lowest library, owns its compiled form; the others share it, if they are compiled with the
# same options (KAUSTIK_INNER_LAYER).
function(kaustik_precompile target header)
  if(NOT KAUSTIK_PRECOMPILED_HEADERS)
    return()
  endif()
  # GCC 12 forgets that a precompiled standard header is a system header, and reports overlapping or overlong copies
  # inside std::string that do not happen.
  target_compile_options(${target} PRIVATE
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overread;-Wno-stringop-overflow>")
  get_target_property(inner ${target} KAUSTIK_INNER_LAYER)
  set(key kaustik_owner_of_${header}_${inner})
  get_property(owner GLOBAL PROPERTY ${key})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/${header})
    set_property(GLOBAL PROPERTY ${key} ${target})
  endif()
endfunction()

# kaustik_join_rooms(<variable>): replaces the sources that the variable lists by one source a room (folder), which
# includes them: the compiler reads the headers once for all of them. A name in an unnamed namespace must be unique in its
# room. Files with SIMD lanes stay alone, since Highway includes them once for every target.
function(kaustik_join_rooms variable)
  if(NOT KAUSTIK_UNITY_BUILD)
    return()
  endif()
  set(rooms "")
  set(joined "")
  foreach(source IN LISTS ${variable})
    file(STRINGS ${source} lanes REGEX "define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
    if(lanes)
      list(APPEND joined ${source})
      continue()
    endif()
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    cmake_path(GET source PARENT_PATH room)
    list(APPEND rooms ${room})
    string(APPEND includes_of_${room} "#include \"${source}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    string(REPLACE "/" "_" name ${room})
    set(file ${PROJECT_BINARY_DIR}/rooms/${name}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${includes_of_${room}}" @ONLY)
    list(APPEND joined ${file})
  endforeach()
  set(${variable} ${joined} PARENT_SCOPE)
endfunction()

# kaustik_library(<name> [libraries...]): makes a static library of every source below the calling folder.
function(kaustik_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  kaustik_join_rooms(sources)
  add_library(kaustik_${name} STATIC ${sources})
  target_link_libraries(kaustik_${name} PUBLIC kaustik_options ${ARGN})
  if(NOT name STREQUAL core)
    set_target_properties(kaustik_${name} PROPERTIES KAUSTIK_INNER_LAYER ON)
  endif()
  if(name STREQUAL core)
    kaustik_precompile(kaustik_core precompiled.h)
  else()
    kaustik_precompile(kaustik_${name} precompiled_scene.h)
  endif()
endfunction()

# kaustik_module(<name> <file> <sources> [libraries...]): makes a library that programs load when they first need it, by
# core/files/module_entry.h. Only its entry function is visible.
function(kaustik_module name file sources)
  add_library(${name} MODULE ${sources})
  target_link_libraries(${name} PRIVATE kaustik_options ${ARGN})
  set_target_properties(${name} PROPERTIES
    PREFIX "" OUTPUT_NAME ${file} SUFFIX .so LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    CXX_VISIBILITY_PRESET hidden)
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/kaustik)
endfunction()

# kaustik_test(<folder> [libraries...]): makes GoogleTest programs of a folder, with one ctest entry per case. Tests that
# call OpenImageIO are a program of their own, test_<folder>_images: to load it takes longer than most tests.
function(kaustik_test folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  set(of_images "")
  foreach(source IN LISTS sources)
    file(STRINGS ${source} calls REGEX "include .*(OpenImageIO/|textured_scenes.h)" LIMIT_COUNT 1)
    if(calls)
      list(APPEND of_images ${source})
    endif()
  endforeach()
  list(REMOVE_ITEM sources ${of_images})
  kaustik_test_program(test_${folder} ${folder} "${sources}" ${ARGN})
  kaustik_test_program(test_${folder}_images ${folder} "${of_images}" ${ARGN} OpenImageIO::OpenImageIO)
endfunction()

function(kaustik_test_program name folder sources)
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} GTest::gtest GTest::gmock GTest::gtest_main)
  kaustik_precompile(${name} precompiled_tests.h)
  target_compile_definitions(${name} PRIVATE
    KAUSTIK_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    KAUSTIK_SCENES_DIR="${PROJECT_SOURCE_DIR}/scenes"
    KAUSTIK_TEST_OUTPUT_DIR="${PROJECT_BINARY_DIR}/tests/output")
  gtest_discover_tests(${name} TEST_PREFIX ${folder}. DISCOVERY_TIMEOUT 60)
endfunction()
