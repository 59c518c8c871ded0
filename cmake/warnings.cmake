# Applied to every target of ours, never to a consumer. -ffp-contract=off: a product and a sum are rounded apart, on every
# machine; -frounding-math: CGAL's interval arithmetic changes the rounding mode.
function(clues_target name)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/clues>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -frounding-math -ffp-contract=off
    $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>)
endfunction()
