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

# clues_kernel_pch: exact numbers, compiled once for all libraries that use them.
function(clues_use_kernel_pch name)
  if(NOT TARGET clues_kernel_pch)
    add_library(clues_kernel_pch STATIC)
    clues_target(clues_kernel_pch)
    target_link_libraries(clues_kernel_pch PUBLIC CGAL::CGAL)
    target_precompile_headers(clues_kernel_pch PRIVATE ${PROJECT_SOURCE_DIR}/exact/kernel.h)
  endif()
  target_precompile_headers(${name} REUSE_FROM clues_kernel_pch)
endfunction()

# clues_chapters(name): every folder of sources is compiled as one piece, in parts of at most twelve files: the templates that its
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
    math(EXPR part "(${count_${chapter}} - 1) / 12")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${chapter}_${part})
  endforeach()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # To GCC a class of a source that is included looks like one of a header.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# What `clues demo` needs, as folders and single sources: a quarter of all. Each library keeps the objects of these in a target of its
# own, NAME_of_demo, and the program clues-demo (`./run demo`) is linked of nothing else. What is missing here, the linker names.
set(demo_sources
  scene scene/files scene/formats scene/mesh scene/messages
  exact exact/cell exact/complex exact/sight
  reference/visibility reference/visibility/planar/plane_frame.cpp reference/visibility/planar/flat_faces.cpp
  reference/visibility/wedges reference/visibility/labels reference/visibility/search reference/visibility/traversal
  reference/visibility/map/discontinuity_mesh.cpp reference/visibility/map/in_doubt.cpp reference/visibility/map/omega.cpp
  reference/visibility/map/regions.cpp reference/visibility/map/side_faces.cpp reference/visibility/map/visibility_map.cpp
  reference/visibility/hidden/render_states.cpp
  fastpath/predicates fastpath/queries
  validate/certificates/chain.cpp validate/certificates/chain_search.cpp validate/certificates/region_points.cpp
  validate/verdicts/area.cpp validate/verdicts/judge.cpp validate/verdicts/judge_report.cpp
  validate/verdicts/light_search.cpp validate/verdicts/measures.cpp
  fuzz/generators/city.cpp fuzz/generators/grid_mesh.cpp
  app/common.cpp app/json_output.cpp app/program.cpp app/progress.cpp app/demo app/commands/command_demo.cpp
  app/view/page_data.cpp app/view/page_json.cpp app/view/viewer_page.cpp)
# clues_demo_part(name): after all else is said of it.
function(clues_demo_part name)
  get_target_property(sources ${name} SOURCES)
  set(part "")
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH chapter)
    if(path IN_LIST demo_sources OR chapter IN_LIST demo_sources)
      list(APPEND part ${source})
    endif()
  endforeach()
  list(REMOVE_ITEM sources ${part})
  add_library(${name}_of_demo OBJECT ${part})
  clues_target(${name}_of_demo)
  clues_chapters(${name}_of_demo)
  get_target_property(libraries ${name} LINK_LIBRARIES)
  target_link_libraries(${name}_of_demo PRIVATE ${libraries})
  get_target_property(options ${name} COMPILE_OPTIONS)
  target_compile_options(${name}_of_demo PRIVATE ${options})
  get_target_property(header ${name} PRECOMPILE_HEADERS_REUSE_FROM)
  if(header)
    target_precompile_headers(${name}_of_demo REUSE_FROM ${header})
  endif()
  set_target_properties(${name} PROPERTIES SOURCES "${sources};$<TARGET_OBJECTS:${name}_of_demo>")
endfunction()
