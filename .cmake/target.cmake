# clues_target(name): what every library and program of ours has in common. The warnings never reach a consumer.
# -ffp-contract=off: a product and a sum are rounded apart, on every machine; -frounding-math: CGAL's interval
# arithmetic changes the rounding mode.
function(clues_target name)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/clues>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -frounding-math -ffp-contract=off
    # GCC 12 suspects CGAL handles that are moved about; clang and valgrind do not.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
    $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>)
  # CGAL would print, once per process, that crossing constraints cost time in exact arithmetic. We know.
  target_compile_definitions(${name} PRIVATE CGAL_NO_CDT_2_WARNING)
  get_target_property(sources ${name} SOURCES)
  if(NOT sources)  # a folder that is still empty is a library all the same
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp CONTENT "// nothing yet\n")
    target_sources(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  endif()
  get_target_property(type ${name} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    # clues_scene is clues::scene here and for whoever finds the installed package.
    string(REPLACE "clues_" "" short ${name})
    add_library(clues::${short} ALIAS ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${short})
  endif()
endfunction()

# clues_chapters(name): every folder of sources is compiled as one piece, in parts of at most six files: the templates that its
# files share are made once, and a first build takes a third of the time. Tests link wrong copies of a few sources in place of
# those in the libraries (tests/planted), so that with tests these are compiled alone. Who works in one file, or compares single
# objects, says CLUES_UNITY=OFF.
option(CLUES_UNITY "Compile each chapter as one piece" ON)
set(alone "")
if(CLUES_BUILD_TESTS)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/planted/plant.py sources ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE alone OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" alone "${alone}")
endif()
function(clues_chapters name)
  if(NOT CLUES_UNITY)
    return()
  endif()
  get_target_property(sources ${name} SOURCES)
  foreach(source IN LISTS sources)
    if(source IN_LIST alone)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      continue()
    endif()
    cmake_path(GET source PARENT_PATH chapter)
    cmake_path(RELATIVE_PATH chapter BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${chapter}" chapter)
    math(EXPR count_${chapter} "${count_${chapter}} + 1")
    math(EXPR part "(${count_${chapter}} - 1) / 6")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${chapter}_${part})
  endforeach()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # To GCC a class of a source that is included looks like one of a header.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
